// Arbitrary output variables: what a pixel's ray hit, beside its colour, as pictures.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/pixel.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image.hpp"

namespace eyeray::cli {

enum class Aov {
  depth,      // t of the first hit, infinity where there is none
  position,   // world
  normal,     // world, shading; 0 where nothing is hit
  uv,         // and 0
  primitive,  // index, −1 where nothing is hit
  material,   // index, −1 where nothing is hit
  hits,       // surfaces struck, the mean of a pixel's samples
  flags,      // what may be wrong with any of a pixel's samples, as a sum of SampleFlags; 0 where nothing is
};

std::string_view aov_name(Aov aov);

// "depth,normal" or "all"; Error (bad_input) for an unknown name.
std::vector<Aov> parse_aovs(const std::string& list);

// Whether it is made of first hits, as all but `hits` and `flags` are.
bool is_of_first_hits(Aov aov);
bool need_first_hits(const std::vector<Aov>& aovs);

// 1 or 3.
int aov_channels(Aov aov);
// What its picture for people is.
FalseColor aov_shown_as(Aov aov);

// Rows of an AOV that is made of first hits; `width` pixels each.
Image aov_image(Aov aov, std::span<const FirstHit> hits, int width);

}  // namespace eyeray::cli
