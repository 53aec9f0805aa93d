// Maps the light of a picture to its look on a screen: for .png, whose colours end at 1.
#pragma once

#include <string_view>

#include "host/image/image.hpp"

namespace eyeray::engine::image {

// From linear light to linear colours of a screen.
//   neutral  Keeps values below 0.76, and squeezes brighter ones below 1, towards white. Khronos PBR Neutral
//            Tone Mapper, 2024.
//   filmic   A film's toe and shoulder in each channel; white is 5.6. Hable, Uncharted 2: HDR Lighting, 2010.
//   aces     The Academy's reference rendering on an sRGB screen, of light that is 1/0.6 times as strong.
//            Stephen Hill's fit in BakingLab, 2016.
//   agx      16.5 stops of light; colours fade as they grow bright. Troy Sobotka's AgX, 2022.
enum class ToneCurve { none, neutral, filmic, aces, agx };
// The names of tone curves in scenes.
inline constexpr std::string_view tone_curves[] = {"none", "neutral", "filmic", "aces", "agx"};

struct Tone {
  double exposure = 0;  // in stops: light is multiplied by 2^exposure
  ToneCurve curve = ToneCurve::none;
  double white_balance = 0;  // the light that is white, in kelvin (optics/temperature.hpp); 0: (1, 1, 1) is
};

// Maps a picture of 3 channels to the colours that a .png shows; the result is still linear: first white
// balance and exposure, then the curve. With 4 channels the last is alpha: colours are multiplied by it in
// `image`, but not in the result. Where it is 0 they are black.
Image toned(const Image& image, const Tone& tone);

}  // namespace eyeray::engine::image
