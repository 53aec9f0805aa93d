#include "host/session/denoised_output.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"
#include "host/denoise/open_image_denoise.hpp"
#include "host/film/noisy_parts.hpp"
#include "host/scene/luminance.hpp"
#include "host/session/warnings.hpp"

namespace eyeray::engine::session {
namespace {

using denoise::NoisyPicture;

film::Channels with_parts(film::Channels channels, bool transparent) {
  return film::with(film::with_noisy_parts(std::move(channels), transparent), {"noisy"});
}

}  // namespace

DenoisedOutput::DenoisedOutput(Denoiser denoiser, Output& output, const film::Channels& shown,
                               bool transparent)
    : denoiser_(denoiser),
      output_(output),
      channels_(with_parts(shown, transparent)),
      transparent_(transparent),
      shown_(output.layered() ? channels_ : shown) {}

void DenoisedOutput::begin(const Plan& plan) {
  Plan inner = plan;
  inner.channels = shown_;
  output_.begin(inner);
  shown_as_one_ = std::exp2(-plan.tone.exposure);
  noise_wanted_ = plan.request.noise;
  picture_.color = image::Image(plan.crop.width, plan.crop.height, 3);
  for (const film::NoisyPart& part : film::noisy_parts(transparent_))
    picture_.*part.image =
        image::Image(plan.crop.width, plan.crop.height, film::channel_named(part.channel)->components);
  rows_.assign(1 + channels_.size(), 0);
}

void DenoisedOutput::write(size_t plane, const image::Image& rows) {
  const auto keep = [&](image::Image& picture) {
    std::ranges::copy(rows.samples(), picture.pixel(0, rows_[plane]));
  };
  if (plane == 0) {
    // The channel of the coverage has the alpha, too.
    const size_t channels = size_t(rows.channels());
    float* color = picture_.color.pixel(0, rows_[0]);
    for (size_t i = 0; i < rows.sample_count(); i += channels, color += 3)
      std::copy_n(&rows.samples()[i], 3, color);
  } else {
    const film::Channel channel = channels_[plane - 1];
    for (const film::NoisyPart& part : film::noisy_parts(transparent_))
      if (part.channel == channel->name) keep(picture_.*part.image);
    // The noise that is left is written at the end.
    if (channel->name != "noise" || !estimates()) pass_on(channel, rows);
  }
  rows_[plane] += rows.height();
}

void DenoisedOutput::pass_on(film::Channel channel, const image::Image& rows) {
  const auto at = std::ranges::find(shown_, channel);
  if (at != shown_.end()) output_.write(1 + size_t(at - shown_.begin()), rows);
}

denoise::DenoisedPicture DenoisedOutput::denoise(const NoisyPicture& picture) {
  const Stopwatch watch;
  if (progress_) progress_(0);
  denoise::DenoisedPicture denoised =
      denoiser_ == Denoiser::own ? denoise_without_loss(picture) : denoise::denoise_by_oidn(picture);
  last_seconds_ = watch.seconds();
  seconds_ += last_seconds_;
  return denoised;
}

denoise::DenoisedPicture DenoisedOutput::denoise_without_loss(const NoisyPicture& picture) {
  stages_->report_to(progress_);
  try {
    return denoise::denoise(picture, *stages_);
  } catch (const Error& error) {
    const bool failed = error.code() == ExitCode::no_device || error.code() == ExitCode::timed_out;
    if (!failed && error.code() != ExitCode::interrupted) throw;
    if (failed) failure_ = error.what();
  }
  stages_ = std::make_unique<denoise::ProcessorStages>();
  stages_->report_to(progress_);
  return denoise::denoise(picture, *stages_);
}

std::vector<double> DenoisedOutput::noise_of(const denoise::DenoisedPicture& picture) const {
  return film::NoiseBlocks(picture.errors.width(), picture.errors.height()).map([&](const Rect& block) {
    double variances = 0, luminances = 0;
    for (int y = block.y; y < block.y + block.height; ++y) {
      for (int x = block.x; x < block.x + block.width; ++x) {
        const double error = double(*picture.errors.pixel(x, y));
        const float* const color = picture.color.pixel(x, y);
        variances += error * error;
        luminances += luminance(Vec3(color[0], color[1], color[2]));
      }
    }
    return film::noise_of(variances, luminances, double(block.pixels()), shown_as_one_);
  });
}

std::vector<double> DenoisedOutput::noise_left(const film::Rows& all) {
  return noise_of(denoise(film::noisy_picture(all, transparent_)));
}

void DenoisedOutput::finish_color() {
  const denoise::DenoisedPicture denoised = denoise(picture_);
  if (estimates()) {
    error_ = denoised.error;
    noise_ = noise_of(denoised);
    const film::NoiseBlocks blocks(picture_.color.width(), picture_.color.height());
    pass_on(film::channel_named("noise"), blocks.as_image(noise_));
  }
  output_.write(0, denoised.color);
  output_.finish_color();
}

void DenoisedOutput::describe(Result& result) const {
  if (result.totals.samples_done == 0 || !estimates()) return;
  result.noise_left = error_;
  const film::NoiseBlocks blocks(picture_.color.width(), picture_.color.height());
  for (int row = 0; row < blocks.rows; ++row) {
    for (int column = 0; column < blocks.columns; ++column) {
      const double noise = noise_[blocks.index(column, row)];
      if (noise <= noise_wanted_) result.totals.quiet_pixels += uint64_t(blocks.block(column, row).pixels());
      result.totals.greatest_noise = std::max(result.totals.greatest_noise, noise);
    }
  }
}

void DenoisedOutput::warn(std::vector<Diagnostic>& warnings) const {
  if (!failure_.empty())
    warnings.push_back(
        warning("the picture was denoised by the processor, because the device failed: " + failure_));
}

void DenoisedOutput::add_times(StageTimes& times) const {
  if (seconds_ == 0) return;
  double rest = seconds_;
  for (const auto& [part, seconds] : stages_->times().stages()) {
    times.add("denoise " + part, seconds);
    rest -= seconds;
  }
  times.add("denoise", rest);
  times.add("encode", -last_seconds_);  // it was measured around finish_color
}

}  // namespace eyeray::engine::session
