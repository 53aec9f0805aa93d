// The source of images that a scene's textures name. The loader decides which files may be read, and how.
#pragma once

#include <memory>
#include <optional>

#include "host/core/diagnostic.hpp"
#include "host/image/image.hpp"
#include "host/scene/image_texture.hpp"

namespace eyeray::engine::reading {

class ImageSource {
 public:
  virtual ~ImageSource() = default;

  // `wanted` with its texels: its name is a file's as it stands at `position`, its size and texels are still
  // empty. Null, with an error in the log, where that cannot be had.
  virtual std::shared_ptr<const ImageTexture> load(ImageTexture wanted, const SourcePosition& position) = 0;
  // The light that a file holds, of three channels: a .hdr, .exr or .pfm. Without an answer as above.
  virtual std::optional<image::Image> load_light(const std::string& name, const SourcePosition& position) = 0;
};

}  // namespace eyeray::engine::reading
