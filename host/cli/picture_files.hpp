// The files of one picture, written as its rows are finished.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/aov/aov.hpp"
#include "host/aov/legend.hpp"
#include "host/cli/layered_file.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image_writer.hpp"
#include "host/render/sums.hpp"

namespace eyeray::cli {

// All that a picture with these outputs and AOVs writes.
std::vector<std::filesystem::path> files_written(const std::vector<std::string>& outputs,
                                                 const std::vector<aov::Aov>& aovs);

// One AOV on its way to NAME.AOV.pfm and NAME.AOV.png, and one of ids to NAME.AOV.json.
class AovFiles {
 public:
  // NAME from `output`; `scene` must outlive it.
  AovFiles(aov::Aov aov, std::filesystem::path output, int width, int height, const Scene& scene);

  // The next rows, from the top down, if it is made of these.
  void write(const render::FinishedRows& rows);
  void write(std::span<const FirstHit> hits);
  // The data takes its place, and is read again to be painted: its range is known only now. Adds the files'
  // names to `files`.
  void finish(std::vector<std::filesystem::path>& files);

 private:
  void write(const image::Image& rows);

  aov::Aov aov_;
  int width_;
  int height_;
  std::filesystem::path data_name_;
  std::filesystem::path picture_name_;
  image::ImageWriter data_;
  image::FalseColorPainter painter_;
  std::optional<aov::Legend> legend_;
};

// Nothing of it is seen before its finish_…; Error (file_io) when a file cannot be written.
class PictureFiles {
 public:
  // AOVs are layers of the first output where that is an .exr, else files of their own. `half`: whether the
  // picture is, in each .exr. `scene`, of which the AOVs are, must outlive it.
  PictureFiles(const std::vector<std::string>& outputs, const std::vector<aov::Aov>& aovs, int width,
               int height, bool half, const Scene& scene);

  // The next rows, from the top down, of the picture and of the AOVs that are made of them.
  void write(const render::FinishedRows& rows);
  // The same of those that are made of first hits.
  void write(std::span<const FirstHit> hits);
  // After the last rows: the picture, then the AOVs, or what is there without them where hits were
  // interrupted. They add the names of what was written to `files`.
  void finish_picture(std::vector<std::filesystem::path>& files);
  void finish_aovs(std::vector<std::filesystem::path>& files);
  void finish_without_aovs(std::vector<std::filesystem::path>& files);

 private:
  image::Tone tone_;
  std::vector<std::pair<std::string, image::ImageWriter>> writers_;  // one an output that is not layered_
  std::optional<LayeredFile> layered_;
  std::vector<AovFiles> aovs_;
};

}  // namespace eyeray::cli
