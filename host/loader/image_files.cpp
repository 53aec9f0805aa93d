#include "host/loader/image_files.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/scene/image_texture_file.hpp"

namespace eyeray::loader {

namespace {

bool same_settings(const ImageTexture& a, const ImageTexture& b) {
  return a.srgb == b.srgb && a.filter == b.filter && a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v;
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

std::shared_ptr<const ImageTexture> ImageFiles::load(ImageTexture wanted, const SourcePosition& position) {
  try {
    const auto source = std::ranges::find(sources_, std::filesystem::path(position.file));
    const auto [path, whole] =
        folders_.find("image", wanted.name, source != sources_.end() ? *source : sources_.front());
    const auto [entry, fresh] = images_.try_emplace(whole);
    auto& [variants, refused] = entry->second;
    if (fresh) {
      if (std::ranges::find(files_, path) == files_.end()) files_.push_back(path);
      try {
        variants.push_back(with_settings(load_image_texture(path, budget_), wanted));
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

}  // namespace eyeray::loader
