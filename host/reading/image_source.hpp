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

  // `wanted` with the size and texels of the file that the scene names at `position`. `wanted` brings the
  // file's name and the settings. Null, with an error in the log, if the file may not or cannot be read.
  virtual std::shared_ptr<const ImageTexture> load(ImageTexture wanted, const SourcePosition& position) = 0;
  // The light that a .hdr, .exr or .pfm file holds, in three channels. Nothing, with an error in the log, if
  // the file may not or cannot be read.
  virtual std::optional<image::Image> load_light(const std::string& name, const SourcePosition& position) = 0;
};

}  // namespace eyeray::engine::reading
