// The channels that a denoiser needs.
#pragma once

#include <string_view>
#include <vector>

#include "host/film/film.hpp"
#include "host/image/noisy_picture.hpp"

namespace eyeray::engine::film {

// A channel, and the image that its values are.
struct NoisyPart {
  std::string_view channel;
  image::Image image::NoisyPicture::* image;
};

// All parts but the colour. `transparent`: whether the picture has an alpha.
std::vector<NoisyPart> noisy_parts(bool transparent);
// These channels, too.
Channels with_noisy_parts(Channels channels, bool transparent);
// The picture of these rows, which are all and have the parts.
image::NoisyPicture noisy_picture(const Rows& all, bool transparent);

}  // namespace eyeray::engine::film
