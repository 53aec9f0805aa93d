#include "host/cli/picture_files.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/image/image_file.hpp"
#include "host/image/pfm_file.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

// How many pixels are painted at a time.
constexpr int painted_pixels = 1 << 20;

bool is_exr(const std::string& output) {
  return image::image_format(output) == image::ImageFormat::exr;
}

}  // namespace

std::vector<fs::path> files_written(const std::vector<std::string>& outputs, const film::Channels& aovs) {
  std::vector<fs::path> files(outputs.begin(), outputs.end());
  for (const film::Channel aov : aovs) {
    if (!is_exr(outputs[0])) {
      files.push_back(film::channel_file(outputs[0], aov, "pfm"));
      files.push_back(film::channel_file(outputs[0], aov, "png"));
    }
    if (aov->legend) files.push_back(film::channel_file(outputs[0], aov, "json"));
  }
  return files;
}

AovFiles::AovFiles(film::Channel aov, fs::path output, int width, int height)
    : width_(width),
      height_(height),
      components_(aov->components),
      data_name_(film::channel_file(output, aov, "pfm")),
      picture_name_(film::channel_file(output, aov, "png")),
      data_(data_name_, width, height, aov->components),
      painter_(aov->shown_as, aov->components) {}

void AovFiles::write(const image::Image& rows) {
  painter_.see(rows);
  data_.write(rows);
}

const fs::path& AovFiles::finish(std::vector<fs::path>& files) {
  data_.finish();
  files.push_back(data_name_);

  image::PfmRows data(data_name_, width_, height_, components_);
  image::ImageWriter picture(picture_name_, width_, height_, 3);
  for (int row = 0; row < height_;) {
    const int count = std::min(std::max(1, painted_pixels / width_), height_ - row);
    picture.write(painter_.paint(data.read(row, count)));
    row += count;
  }
  picture.finish();
  files.push_back(picture_name_);
  return picture_name_;
}

PictureFiles::PictureFiles(const std::vector<std::string>& outputs, const film::Channels& aovs, int width,
                           int height, bool half, const image::Tone& tone)
    : output_(outputs[0]), wanted_(aovs), tone_(tone) {
  for (const std::string& output : outputs) {
    const bool exr = is_exr(output);
    if (exr && &output == &outputs[0] && !aovs.empty())
      layered_.emplace(output, aovs, width, height, half);
    else if (exr)
      writers_.emplace_back(output, image::ImageWriter(output, width, height, image::exr_channels(3, half)));
    else
      writers_.emplace_back(output, image::ImageWriter(output, width, height, 3));
  }
  if (layered_) return;
  for (const film::Channel aov : aovs) aovs_.emplace_back(aov, outputs[0], width, height);
}

void PictureFiles::write(const image::Image& color) {
  for (auto& [name, writer] : writers_)
    writer.write(image::image_format(name) == image::ImageFormat::png ? image::toned(color, tone_) : color);
  if (layered_) layered_->write(color);
}

void PictureFiles::write(size_t aov, const image::Image& rows) {
  if (layered_)
    layered_->write(aov, rows);
  else
    aovs_[aov].write(rows);
}

void PictureFiles::finish_picture(std::vector<fs::path>& files) {
  for (auto& [name, writer] : writers_) {
    writer.finish();
    files.emplace_back(name);
  }
}

void PictureFiles::finish_aovs(std::vector<fs::path>& files, const LegendOf& write_legend) {
  for (size_t i = 0; i < aovs_.size(); ++i) {
    const fs::path& picture = aovs_[i].finish(files);
    if (wanted_[i]->legend) files.push_back(write_legend(i, picture));
  }
  if (!layered_) return;
  layered_->finish(files, true);
  for (size_t i = 0; i < wanted_.size(); ++i)
    if (wanted_[i]->legend) files.push_back(write_legend(i, film::channel_file(output_, wanted_[i], "json")));
}

void PictureFiles::finish_without_aovs(std::vector<fs::path>& files) {
  if (layered_) layered_->finish(files, false);
}

}  // namespace eyeray::cli
