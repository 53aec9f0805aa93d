#include "host/session/picture_files.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/image/image_file.hpp"
#include "host/image/pfm_file.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::session {
namespace {

// The number of pixels painted at a time.
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

PictureFiles::PictureFiles(std::vector<std::string> outputs, const film::Channels& aovs, bool half)
    : outputs_(std::move(outputs)), aovs_(aovs), half_(half) {}

std::vector<fs::path> PictureFiles::files() const {
  return files_written(outputs_, aovs_);
}

bool PictureFiles::layered() const {
  return is_exr(outputs_[0]);
}

void PictureFiles::begin(const Plan& plan) {
  aovs_ = plan.channels;
  begin(plan.crop.width, plan.crop.height, plan.tone, plan.color_channels());
}

void PictureFiles::begin(int width, int height, const image::Tone& tone, int channels) {
  if (channels == 4) std::ranges::for_each(outputs_, image::check_has_alpha);
  channels_ = channels;
  width_ = width;
  height_ = height;
  tone_ = tone;
}

void PictureFiles::open() {
  opened_ = true;
  for (const std::string& output : outputs_) {
    const bool exr = is_exr(output);
    if (exr && &output == &outputs_[0] && !aovs_.empty())
      layered_.emplace(output, aovs_, width_, height_, image::exr_channels(channels_, half_));
    else if (exr)
      writers_.emplace_back(
          output, image::ImageWriter(output, width_, height_, image::exr_channels(channels_, half_)));
    else
      writers_.emplace_back(output, image::ImageWriter(output, width_, height_, channels_));
  }
  if (layered_) return;
  for (const film::Channel aov : aovs_) aov_files_.emplace_back(aov, outputs_[0], width_, height_);
}

void PictureFiles::write(size_t plane, const image::Image& rows) {
  if (!opened_) open();
  if (layered_) layered_->write(plane, rows);
  if (plane > 0) {
    if (!layered_) aov_files_[plane - 1].write(rows);
    return;
  }
  for (auto& [name, writer] : writers_)
    writer.write(image::image_format(name) == image::ImageFormat::png ? image::toned(rows, tone_) : rows);
}

void PictureFiles::finish_color() {
  for (auto& [name, writer] : writers_) {
    writer.finish();
    written_.emplace_back(name);
  }
}

void PictureFiles::finish(const film::ChannelValues& values, Result& result) {
  if (!result.interrupted())
    finish_aovs([&](size_t aov, const fs::path& file) { return values.legend(aovs_[aov])->write(file); });
  else if (layered_ && result.totals.samples_done > 0)
    layered_->finish(written_, false);
  result.files = written_;
}

void PictureFiles::finish_aovs(const LegendOf& write_legend) {
  for (size_t i = 0; i < aov_files_.size(); ++i) {
    const fs::path& picture = aov_files_[i].finish(written_);
    if (aovs_[i]->legend) written_.push_back(write_legend(i, picture));
  }
  if (!layered_) return;
  layered_->finish(written_, true);
  for (size_t i = 0; i < aovs_.size(); ++i)
    if (aovs_[i]->legend)
      written_.push_back(write_legend(i, film::channel_file(outputs_[0], aovs_[i], "json")));
}

}  // namespace eyeray::engine::session
