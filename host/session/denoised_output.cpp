#include "host/session/denoised_output.hpp"

#include <algorithm>

namespace eyeray::engine::session {
namespace {

using denoise::NoisyPicture;

// The channels that denoising needs, and where they go.
struct Part {
  std::string_view channel;
  image::Image NoisyPicture::* image;
};
constexpr Part usual_parts[] = {
    {"half", &NoisyPicture::half_color},       {"variance", &NoisyPicture::variance},
    {"albedo", &NoisyPicture::albedo},         {"half_albedo", &NoisyPicture::half_albedo},
    {"shading_normal", &NoisyPicture::normal}, {"half_normal", &NoisyPicture::half_normal},
    {"samples", &NoisyPicture::samples},
};
// Those that it needs as well for an alpha.
constexpr Part alpha_parts[] = {{"coverage", &NoisyPicture::coverage},
                                {"half_coverage", &NoisyPicture::half_coverage}};

std::vector<Part> parts_of(bool transparent) {
  std::vector<Part> parts(std::begin(usual_parts), std::end(usual_parts));
  if (transparent) parts.insert(parts.end(), std::begin(alpha_parts), std::end(alpha_parts));
  return parts;
}

film::Channels with_parts(film::Channels channels, bool transparent) {
  for (const Part& part : parts_of(transparent)) channels = film::with(channels, {part.channel});
  return film::with(channels, {"noisy"});
}

}  // namespace

DenoisedOutput::DenoisedOutput(Output& output, const film::Channels& shown, bool transparent)
    : output_(output),
      channels_(with_parts(shown, transparent)),
      transparent_(transparent),
      shown_(output.layered() ? channels_ : shown) {}

void DenoisedOutput::begin(const Plan& plan) {
  Plan inner = plan;
  inner.channels = shown_;
  output_.begin(inner);
  picture_.color = image::Image(plan.crop.width, plan.crop.height, 3);
  for (const Part& part : parts_of(transparent_))
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
    for (const Part& part : parts_of(transparent_))
      if (part.channel == channel->name) keep(picture_.*part.image);
    const auto at = std::ranges::find(shown_, channel);
    if (at != shown_.end()) output_.write(1 + size_t(at - shown_.begin()), rows);
  }
  rows_[plane] += rows.height();
}

void DenoisedOutput::finish_color() {
  const Stopwatch watch;
  const denoise::DenoisedPicture denoised = denoise::denoise(picture_);
  error_ = denoised.error;
  seconds_ = watch.seconds();
  output_.write(0, denoised.color);
  output_.finish_color();
}

void DenoisedOutput::describe(Result& result) const {
  if (result.totals.samples_done == 0) return;
  result.noise_left = error_;
  result.times.add("denoise", seconds_);
  result.times.add("encode", -seconds_);  // it was measured around finish_color
}

}  // namespace eyeray::engine::session
