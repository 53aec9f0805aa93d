// The pictures that a mesh file names, each decoded once. Private to the importers.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "host/image/coded_image.hpp"
#include "host/importers/asset_files.hpp"
#include "host/textures/make.hpp"

namespace eyeray::engine::importers {

// A color, times `picture` unless it is null.
TexturePtr textured(const Vec3& color, std::shared_ptr<const ImageTexture> picture);

class TextureFiles {
 public:
  TextureFiles(AssetFiles& assets, image::PixelBudget& budget, std::vector<std::string>& warnings)
      : assets_(assets), budget_(budget), warnings_(warnings) {}

  // Makes a picture; may throw Error, and add warnings.
  using Decode = std::function<ImageTexture(image::PixelBudget&, std::vector<std::string>& warnings)>;

  // The picture in a file; null, with a warning, if it cannot be read. TooManyPixels beyond the budget.
  std::shared_ptr<const ImageTexture> load(const std::string& name);
  // The picture called `name`, which `decode` makes on first use.
  std::shared_ptr<const ImageTexture> load(const std::string& name, const Decode& decode);

 private:
  AssetFiles& assets_;
  image::PixelBudget& budget_;
  std::vector<std::string>& warnings_;
  std::map<std::string, std::shared_ptr<const ImageTexture>> known_;
};

}  // namespace eyeray::engine::importers
