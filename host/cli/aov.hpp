// Arbitrary output variables: what a pixel's ray met, beside its colour, as pictures.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/image.hpp"
#include "render/executor.hpp"

namespace eyeray::cli {

enum class Aov {
  depth,      // t of the first hit, infinity where there is none
  position,   // world
  normal,     // world, shading; 0 where nothing is hit
  uv,         // and 0
  primitive,  // index, −1 where nothing is hit
  material,   // index, −1 where nothing is hit
  hits,       // surfaces struck, the mean of a pixel's samples
};

std::string_view aov_name(Aov aov);

// "depth,normal" or "all"; Error (bad_input) for an unknown name.
std::vector<Aov> parse_aovs(const std::string& list);

// Whether any of them needs Rendering::first_hits.
bool need_first_hits(const std::vector<Aov>& aovs);

// 1 or 3 channels, the size of rendering.color.
Image aov_image(Aov aov, const Rendering& rendering);
// The same for people: 3 channels of false colour.
Image aov_picture(Aov aov, const Image& image);

}  // namespace eyeray::cli
