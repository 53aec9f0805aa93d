#include "host/film/noisy_parts.hpp"

namespace eyeray::engine::film {
namespace {

using image::NoisyPicture;

constexpr NoisyPart usual_parts[] = {
    {"half", &NoisyPicture::half_color},       {"variance", &NoisyPicture::variance},
    {"albedo", &NoisyPicture::albedo},         {"half_albedo", &NoisyPicture::half_albedo},
    {"shading_normal", &NoisyPicture::normal}, {"half_normal", &NoisyPicture::half_normal},
    {"samples", &NoisyPicture::samples},
};
constexpr NoisyPart alpha_parts[] = {{"coverage", &NoisyPicture::coverage},
                                     {"half_coverage", &NoisyPicture::half_coverage}};

}  // namespace

std::vector<NoisyPart> noisy_parts(bool transparent) {
  std::vector<NoisyPart> parts(std::begin(usual_parts), std::end(usual_parts));
  if (transparent) parts.insert(parts.end(), std::begin(alpha_parts), std::end(alpha_parts));
  return parts;
}

Channels with_noisy_parts(Channels channels, bool transparent) {
  for (const NoisyPart& part : noisy_parts(transparent)) channels = with(channels, {part.channel});
  return channels;
}

NoisyPicture noisy_picture(const Rows& all, bool transparent) {
  NoisyPicture picture;
  picture.color = all.color;
  for (const NoisyPart& part : noisy_parts(transparent))
    picture.*part.image = all[channel_named(part.channel)];
  return picture;
}

}  // namespace eyeray::engine::film
