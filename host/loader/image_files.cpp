#include "host/loader/image_files.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/image/image_file.hpp"
#include "host/scene/image_texture_file.hpp"

namespace eyeray::engine::loader {

namespace {

bool same_settings(const ImageTexture& a, const ImageTexture& b) {
  return a.srgb == b.srgb && a.filter == b.filter && a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v;
}

image::Image read_light(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  check_image_file(path);
  return image::in_color(image::read_image(path, "", warnings));
}

// `from` with the settings of `wanted`.
std::shared_ptr<const ImageTexture> with_settings(ImageTexture from, const ImageTexture& wanted) {
  from.srgb = wanted.srgb;
  from.filter = wanted.filter;
  from.wrap_u = wanted.wrap_u;
  from.wrap_v = wanted.wrap_v;
  return std::make_shared<const ImageTexture>(std::move(from));
}

}  // namespace

std::optional<image::Image> ImageFiles::load_light(const std::string& name, const SourcePosition& position) {
  try {
    const auto [path, whole] = files_.find("image", name, position);
    if (image::image_format(path) == image::ImageFormat::png)
      throw Error(ExitCode::bad_input,
                  "{}: a .png stores colours for a screen, not light; use a .hdr, .exr or .pfm",
                  path.string());
    files_.add(path);
    std::vector<std::string> warnings;
    image::Image light = read_light(path, warnings);
    for (const std::string& warning : warnings) log_.warning(position, warning);
    return light;
  } catch (const Error& unreadable) {
    log_.error(position, unreadable.what());
    return std::nullopt;
  }
}

std::shared_ptr<const ImageTexture> ImageFiles::load(ImageTexture wanted, const SourcePosition& position) {
  try {
    const auto [path, whole] = files_.find("image", wanted.name, position);
    const auto [entry, fresh] = images_.try_emplace(whole);
    auto& [variants, refused] = entry->second;
    if (fresh) {
      files_.add(path);
      try {
        std::vector<std::string> warnings;
        variants.push_back(with_settings(load_image_texture(path, budget_, warnings), wanted));
        for (const std::string& warning : warnings) log_.warning(position, warning);
      } catch (const Error& unreadable) {
        refused = unreadable.what();
      }
    }
    if (!refused.empty()) throw Error(ExitCode::file_io, refused);
    const auto found =
        std::ranges::find_if(variants, [&](const auto& image) { return same_settings(*image, wanted); });
    if (found != variants.end()) return *found;
    budget_.take(variants.front()->width, variants.front()->height, path.string());
    variants.push_back(with_settings(*variants.front(), wanted));
    return variants.back();
  } catch (const Error& unreadable) {
    log_.error(position, unreadable.what());
    return nullptr;
  }
}

}  // namespace eyeray::engine::loader
