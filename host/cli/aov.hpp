// Arbitrary output variables: what a pixel's ray hit, beside its colour, as pictures. An AOV is one row in
// aov.cpp.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host/cli/legend.hpp"
#include "host/core/pixel.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image.hpp"
#include "host/render/sums.hpp"

namespace eyeray::cli {

// Where an AOV's values come from: the first hit of a pixel's centre, of whose three as many count as it has
// channels, or what was summed over its samples.
using ValueOfHit = Vec3 (*)(const FirstHit& hit);
using ValuesOfRows = const Image& (*)(const render::FinishedRows& rows);

struct AovType {
  std::string_view name;
  int channels;         // 1 or 3
  FalseColor shown_as;  // in its picture for people
  std::variant<ValueOfHit, ValuesOfRows> values;
  // Of ids: what they stand for; `scene` must outlive it. Else null.
  std::unique_ptr<LegendEntries> (*legend)(const Scene& scene) = nullptr;

  bool is_of_first_hits() const { return std::holds_alternative<ValueOfHit>(values); }
};

using Aov = const AovType*;

// All, in the order in which they are listed.
std::span<const AovType> aov_types();
// "depth, position, …".
std::string aov_names();

// "depth,normal" or "all"; Error (bad_input) for an unknown name.
std::vector<Aov> parse_aovs(const std::string& list);

bool need_first_hits(const std::vector<Aov>& aovs);

// Rows of an AOV that is made of first hits; `width` pixels each.
Image aov_image(Aov aov, std::span<const FirstHit> hits, int width);

}  // namespace eyeray::cli
