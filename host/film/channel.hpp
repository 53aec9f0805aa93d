// The data that a picture may have beside its colour, a channel a row in channels.cpp: values of the first
// hits at pixels' centres, and sums over pixels' samples. Users know channels as AOVs (arbitrary output
// variables).
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host/core/pixel.hpp"
#include "host/film/legend.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine::film {

// The sums of a pixel's samples. Checkpoints contain them as they lie in memory.
struct PixelTotals {
  Vec3 color{0.0};
  uint32_t hits = 0;
  uint32_t rays = 0;
  uint32_t flags = 0;
  uint32_t samples : 31 = 0;
  uint32_t finished : 1 = 0;  // whether it takes no more (render/adaptive.hpp)
};

// The source of a channel's values: the first hit at a pixel's centre, the hit's entry in the legend, or the
// pixel's samples. As many of ValueOfHit's three numbers count as the channel has components.
using ValueOfHit = Vec3 (*)(const FirstHit& hit);
struct EntryOfLegend {};
struct OfSamples {
  int sums = 0;  // float64 values a pixel, 0 at first
  void (*add)(const PixelSample& sample, const AuxiliarySample& auxiliary, double* sums) = nullptr;
  // The values of a pixel of which all samples are added; one that has none gets 0. Null: the noise of the
  // pixel's block (Film::noise), of which `sums` are the squared luminances.
  void (*mean)(const PixelTotals& totals, const double* sums, float* values) = nullptr;
};

// Values that executors compute only on request.
enum class Needs { nothing, ray_kinds, search_cost, auxiliary };

// The value of pixels that are made from samples at their four corners (render/corners.hpp).
enum class OfCorners { nothing, mean, any_bit };

struct ChannelType {
  std::string_view name;
  int components;  // 1 or 3
  // Their names in its layer of an .exr; where none is named, V or X, Y and Z.
  std::array<std::string_view, 3> component_names{};
  image::FalseColor shown_as;  // in its picture for people
  std::variant<ValueOfHit, EntryOfLegend, OfSamples> values;
  Needs needs = Needs::nothing;
  OfCorners of_corners = OfCorners::nothing;
  // The meaning of ids. `scene` must outlive it. Null if the values are no ids.
  std::unique_ptr<LegendEntries> (*legend)(const Scene& scene) = nullptr;

  // Null where it is of first hits.
  const OfSamples* of_samples() const { return std::get_if<OfSamples>(&values); }
};

using Channel = const ChannelType*;
// In the order of the rows, none twice.
using Channels = std::vector<Channel>;

// All, in the order in which they are listed.
std::span<const ChannelType> channel_types();
// "depth, position, …": of all, or of these.
std::string channel_names();
std::string channel_names(const Channels& channels);
// By its name, which must be one.
Channel channel_named(std::string_view name);
// "depth,normal" or "all"; Error (bad_input) for an unknown name.
Channels parse_channels(const std::string& list);

bool contains(const Channels& channels, Channel channel);
Channels with(Channels channels, std::initializer_list<std::string_view> names);
bool any_of_first_hits(const Channels& channels);
bool any_needs(const Channels& channels, Needs what);
// The wanted channels that a scene has. Error (bad_input) for AOVs that its integrator does not make; these
// are left out if all are wanted.
Channels channels_of(const Scene& scene, Channels wanted);

// The components of its layer of an .exr: "normal.X" and so on; no more than it has, and fewer where its last
// means nothing.
std::vector<std::string> layer_components(Channel channel);
// NAME.CHANNEL.ENDING for an output NAME.….
std::filesystem::path channel_file(std::filesystem::path output, Channel channel, std::string_view ending);
// Rows of a channel of first hits; `width` pixels each. `entries` of its legend, where it has one.
image::Image channel_image(Channel channel, std::span<const FirstHit> hits, int width,
                           const LegendEntries* entries);

}  // namespace eyeray::engine::film
