// The files of one picture, written as its rows are finished.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/cli/layered_file.hpp"
#include "host/film/channel.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image_writer.hpp"
#include "host/image/tone.hpp"

namespace eyeray::cli {

// All that a picture with these outputs and AOVs writes.
std::vector<std::filesystem::path> files_written(const std::vector<std::string>& outputs,
                                                 const film::Channels& aovs);

// Writes the legend of an AOV of ids, by its index, beside its picture, and returns its name.
using LegendOf = std::function<std::filesystem::path(size_t aov, const std::filesystem::path& picture)>;

// One AOV on its way to NAME.AOV.pfm and NAME.AOV.png.
class AovFiles {
 public:
  // NAME from `output`.
  AovFiles(film::Channel aov, std::filesystem::path output, int width, int height);

  // The next rows, from the top down.
  void write(const image::Image& rows);
  // The data takes its place, and is read again to be painted: its range is known only now. Adds the files'
  // names to `files`. Returns that of the picture.
  const std::filesystem::path& finish(std::vector<std::filesystem::path>& files);

 private:
  int width_;
  int height_;
  int components_;
  std::filesystem::path data_name_;
  std::filesystem::path picture_name_;
  image::ImageWriter data_;
  image::FalseColorPainter painter_;
};

// Nothing of it is seen before its finish_…; Error (file_io) when a file cannot be written.
class PictureFiles {
 public:
  // AOVs are layers of the first output where that is an .exr, else files of their own. `half`: whether the
  // picture is, in each .exr. `tone`: of each .png.
  PictureFiles(const std::vector<std::string>& outputs, const film::Channels& aovs, int width, int height,
               bool half, const image::Tone& tone);

  // The next rows, from the top down, of the picture or of an AOV, by its index.
  void write(const image::Image& color);
  void write(size_t aov, const image::Image& rows);
  // After the last rows: the picture, then the AOVs, or what is there without them where hits were
  // interrupted. They add the names of what was written to `files`.
  void finish_picture(std::vector<std::filesystem::path>& files);
  void finish_aovs(std::vector<std::filesystem::path>& files, const LegendOf& write_legend);
  void finish_without_aovs(std::vector<std::filesystem::path>& files);

 private:
  std::string output_;  // the first
  film::Channels wanted_;
  image::Tone tone_;
  std::vector<std::pair<std::string, image::ImageWriter>> writers_;  // one an output that is not layered_
  std::optional<LayeredFile> layered_;
  std::vector<AovFiles> aovs_;  // none where layered_
};

}  // namespace eyeray::cli
