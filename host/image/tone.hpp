// Maps the light of a picture to its look on a screen: for .png, whose colours end at 1.
#pragma once

#include <string_view>

#include "host/image/image.hpp"

namespace eyeray::engine::image {

enum class ToneCurve { none, neutral };
// The names of tone curves in scenes.
inline constexpr std::string_view tone_curves[] = {"none", "neutral"};

struct Tone {
  double exposure = 0;  // in stops: light is multiplied by 2^exposure
  ToneCurve curve = ToneCurve::none;
};

// Maps a picture of 3 channels to the colours that a .png shows; the result is still linear. `neutral` keeps
// values below 0.76, and squeezes brighter ones below 1, towards white: Khronos PBR Neutral Tone Mapper,
// 2024.
Image toned(const Image& image, const Tone& tone);

}  // namespace eyeray::engine::image
