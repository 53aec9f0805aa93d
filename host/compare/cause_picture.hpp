// Pictures that show why pixels differ.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/compare/against_reference.hpp"

namespace eyeray::engine::compare {

// Shows the linear `background` dark and grey, and over it each pixel that does not match, in the colour of
// its cause. Unexplained pixels are red; the others have colours that Okabe and Ito chose for all kinds of
// eyes (docs/report.md). `outcomes`: one for each pixel.
image::Image cause_picture(const image::Image& background, const std::vector<PixelOutcome>& outcomes);

// The legend of such a picture, as JSON: {"silhouette": {"color": "#0072b2", "pixels": 8}, …}.
std::string cause_legend(const std::vector<PixelOutcome>& outcomes);

}  // namespace eyeray::engine::compare
