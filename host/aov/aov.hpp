// Arbitrary output variables: what a pixel's ray hit, beside its colour, as pictures. An AOV is one row in
// aov.cpp.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host/aov/legend.hpp"
#include "host/core/pixel.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image.hpp"
#include "host/render/sums.hpp"

namespace eyeray::aov {

// Where an AOV's values come from: the first hit of a pixel's centre, of whose three as many count as it has
// channels; the legend's entry that it is of; or what was summed over the pixel's samples.
using ValueOfHit = Vec3 (*)(const FirstHit& hit);
struct EntryOfLegend {};
using ValuesOfRows = image::Image (*)(const render::FinishedRows& rows);

// What executors count only where it is asked for.
enum class AovNeeds { nothing, ray_kinds, search_cost, noise, brightest, auxiliary };
// Of it what PixelSums count.
constexpr render::Counted counted_for(AovNeeds needs) {
  return {.kinds = needs == AovNeeds::ray_kinds,
          .noise = needs == AovNeeds::noise,
          .brightest = needs == AovNeeds::brightest,
          .auxiliary = needs == AovNeeds::auxiliary};
}

struct AovType {
  std::string_view name;
  int channels;  // 1 or 3
  // Its channels in its layer of an .exr; where none is named, V or X, Y and Z.
  std::array<std::string_view, 3> components{};
  image::FalseColor shown_as;  // in its picture for people
  std::variant<ValueOfHit, EntryOfLegend, ValuesOfRows> values;
  AovNeeds needs = AovNeeds::nothing;
  // Of ids: what they stand for; `scene` must outlive it. Else null.
  std::unique_ptr<LegendEntries> (*legend)(const Scene& scene) = nullptr;

  bool is_of_first_hits() const { return !std::holds_alternative<ValuesOfRows>(values); }
};

using Aov = const AovType*;

// All, in the order in which they are listed.
std::span<const AovType> aov_types();
// The channels of its layer of an .exr: "normal.X" and so on; no more than it has, and fewer where its last
// says nothing.
std::vector<std::string> layer_channels(Aov aov);
// "depth, position, …".
std::string aov_names();

// "depth,normal" or "all"; Error (bad_input) for an unknown name.
std::vector<Aov> parse_aovs(const std::string& list);

// NAME.AOV.ENDING for an output NAME.….
std::filesystem::path aov_file(std::filesystem::path output, Aov aov, std::string_view ending);

bool need_first_hits(const std::vector<Aov>& aovs);
bool any_needs(const std::vector<Aov>& aovs, AovNeeds what);

// Rows of an AOV that is made of first hits; `width` pixels each. `entries` of its legend, where it has one.
image::Image aov_image(Aov aov, std::span<const FirstHit> hits, int width, const LegendEntries* entries);

}  // namespace eyeray::aov
