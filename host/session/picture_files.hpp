// The files of one picture, written as its rows are finished.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/film/channel.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image_writer.hpp"
#include "host/image/tone.hpp"
#include "host/session/layered_file.hpp"
#include "host/session/output.hpp"

namespace eyeray::engine::session {

// All files that a picture with these outputs and AOVs writes.
std::vector<std::filesystem::path> files_written(const std::vector<std::string>& outputs,
                                                 const film::Channels& aovs);

// Writes the legend of an AOV of ids, by its index, beside its picture, and returns its name.
using LegendOf = std::function<std::filesystem::path(size_t aov, const std::filesystem::path& picture)>;

// One AOV on its way to NAME.AOV.pfm and NAME.AOV.png.
class AovFiles {
 public:
  // NAME is taken from `output`.
  AovFiles(film::Channel aov, std::filesystem::path output, int width, int height);

  // The next rows, from the top down.
  void write(const image::Image& rows);
  // Finishes the .pfm, and reads it again to paint the .png: only now is the range of the data known. Adds
  // the files' names to `files`. Returns the .png's name.
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

// A file appears whole or not at all; Error (file_io) when one cannot be written.
class PictureFiles final : public Output {
 public:
  // `outputs`: at least one. AOVs are layers of the first if it is an .exr, else separate files. `half`:
  // whether the colour in each .exr is half floats.
  PictureFiles(std::vector<std::string> outputs, const film::Channels& aovs, bool half);

  std::vector<std::filesystem::path> files() const override;
  bool layered() const override;
  void begin(const Plan& plan) override;
  // Begins a picture that is not rendered now. `tone`: the tone curve of each .png. `channels`: those of its
  // colour (Plan::color_channels). Error (bad_input) if an output cannot have them.
  void begin(int width, int height, const image::Tone& tone, int channels);
  // Opens the files only when the first rows arrive, which for a picture of one band is when it is done.
  void write(size_t plane, const image::Image& rows) override;
  void finish_color() override;
  void finish(const film::ChannelValues& values, Result& result) override;
  // Finishes the AOVs, which must all be complete.
  void finish_aovs(const LegendOf& write_legend);
  const std::vector<std::filesystem::path>& written() const { return written_; }

 private:
  void open();

  std::vector<std::string> outputs_;
  film::Channels aovs_;
  bool half_;
  int width_ = 0, height_ = 0, channels_ = 3;
  image::Tone tone_;
  bool opened_ = false;
  std::vector<std::pair<std::string, image::ImageWriter>> writers_;  // one for each output except layered_
  std::optional<LayeredFile> layered_;
  std::vector<AovFiles> aov_files_;  // empty with layered_
  std::vector<std::filesystem::path> written_;
};

}  // namespace eyeray::engine::session
