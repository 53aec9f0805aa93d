// The image files of one scene, each read once. Private to the loader.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/image/coded_image.hpp"
#include "host/loader/allowed_folders.hpp"
#include "host/reading/image_source.hpp"

namespace eyeray::engine::loader {

class ImageFiles final : public reading::ImageSource {
 public:
  // `sources`: the scene's file, then the files that it includes. A name in one of them is relative to that
  // file's folder. A name in none of them, such as an override, is relative to the scene's folder.
  ImageFiles(const AllowedFolders& folders, std::vector<std::filesystem::path> sources,
             image::PixelBudget& budget, DiagnosticLog& log)
      : folders_(folders), sources_(std::move(sources)), budget_(budget), log_(log) {}

  std::shared_ptr<const ImageTexture> load(ImageTexture wanted, const SourcePosition& position) override;
  std::optional<image::Image> load_light(const std::string& name, const SourcePosition& position) override;

  // Every file that was requested, in the order in which they were first named.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  AllowedFolders::File find(const std::string& name, const SourcePosition& position);
  void take_note(const std::filesystem::path& path);

  const AllowedFolders& folders_;
  std::vector<std::filesystem::path> sources_;  // the scene first
  image::PixelBudget& budget_;
  DiagnosticLog& log_;
  std::vector<std::filesystem::path> files_;
  struct Entry {
    // The texels with each requested filter, wrap and colour space.
    std::vector<std::shared_ptr<const ImageTexture>> variants;
    std::string refused;  // the reason why there are no variants
  };
  std::map<std::filesystem::path, Entry> images_;  // by canonical path
};

}  // namespace eyeray::engine::loader
