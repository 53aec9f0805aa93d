#include "host/importers/texture_files.hpp"

#include "host/core/error.hpp"
#include "host/scene/image_texture_file.hpp"

namespace eyeray::engine::importers {

TexturePtr textured(const Vec3& color, std::shared_ptr<const ImageTexture> picture) {
  return picture ? textures::make_image(std::move(picture), color) : textures::make_constant(color);
}

std::shared_ptr<const ImageTexture> TextureFiles::load(const std::string& name) {
  return load(name, [&](image::PixelBudget& budget, std::vector<std::string>& warnings) {
    return load_image_texture(assets_.locate(name), budget, warnings);
  });
}

std::shared_ptr<const ImageTexture> TextureFiles::load(const std::string& name, const Decode& decode) {
  const auto [entry, fresh] = known_.try_emplace(name);
  if (!fresh) return entry->second;
  try {
    entry->second = std::make_shared<const ImageTexture>(decode(budget_, warnings_));
  } catch (const image::TooManyPixels&) {
    throw;
  } catch (const Error& error) {
    warnings_.push_back(std::string("a picture was left out: ") + error.what());
  }
  return entry->second;
}

}  // namespace eyeray::engine::importers
