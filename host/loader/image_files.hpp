// The image files of one scene, each read once. Private to the loader.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/image/coded_image.hpp"
#include "host/loader/named_files.hpp"
#include "host/reading/image_source.hpp"

namespace eyeray::engine::loader {

class ImageFiles final : public reading::ImageSource {
 public:
  ImageFiles(NamedFiles& files, image::PixelBudget& budget, DiagnosticLog& log)
      : files_(files), budget_(budget), log_(log) {}

  std::shared_ptr<const ImageTexture> load(ImageTexture wanted, const SourcePosition& position) override;
  std::optional<image::Image> load_light(const std::string& name, const SourcePosition& position) override;

 private:
  NamedFiles& files_;
  image::PixelBudget& budget_;
  DiagnosticLog& log_;
  struct Entry {
    // The texels with each requested filter, wrap and colour space.
    std::vector<std::shared_ptr<const ImageTexture>> variants;
    std::string refused;  // the reason why there are no variants
  };
  std::map<std::filesystem::path, Entry> images_;  // by canonical path
};

}  // namespace eyeray::engine::loader
