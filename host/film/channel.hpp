// The data that a picture may have beside its colour: values of the first hits at pixels' centres, and sums
// over pixels' samples. Each row of the table in channels.cpp is a channel. Users know channels as AOVs
// (arbitrary output variables).
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
  uint32_t finished : 1 = 0;  // whether the pixel takes no more samples (render/adaptive.hpp)
};

// The source of a channel's values: the first hit at a pixel's centre, the hit's entry in the legend, or the
// pixel's samples. A channel of one component uses only the first of ValueOfHit's three numbers.
using ValueOfHit = Vec3 (*)(const FirstHit& hit);
struct EntryOfLegend {};

// Samples of a pixel that do not count (film/outliers.hpp), and the mean of the others, which stands for
// each.
struct LeftOut {
  Vec3 sum;         // their colours
  Vec3 mean;        // the mean colour of the pixel's other samples
  double samples;   // their number
  double others;    // the number of the others
  bool first_half;  // whether the channel `half` has them
};

// A sample to add to the sums of its pixel.
struct AddedSample {
  const PixelSample& sample;
  const AuxiliarySample& auxiliary;
  uint64_t number;  // the number of the pixel's samples before it
};

struct OfSamples {
  int sums = 0;  // number of float64 sums a pixel; each starts at 0
  void (*add)(const AddedSample& added, double* sums) = nullptr;
  // Writes the values of a pixel whose samples have all been added; 0 for a pixel without samples. Null: the
  // value is the noise of the pixel's block (Film::noise), and its one sum is that of squared luminances.
  void (*mean)(const PixelTotals& totals, const double* sums, float* values) = nullptr;
  // Changes the sums of a channel of colours as if these samples had the mean of the others. Null: they do
  // not change.
  void (*leave_out)(const LeftOut& samples, double* sums) = nullptr;
};

// Values that executors compute only on request, and coverage, which only a transparent picture has.
enum class Needs { nothing, ray_kinds, search_cost, auxiliary, coverage };

// The value of pixels that are made from samples at their four corners (render/corners.hpp).
enum class OfCorners { nothing, mean, any_bit };

struct ChannelType {
  std::string_view name;
  int components;  // 1 or 3
  // The components' names in the channel's layer of an .exr. If none is named: V, or X, Y and Z.
  std::array<std::string_view, 3> component_names{};
  image::FalseColor shown_as;  // the false colours of its picture for people
  std::variant<ValueOfHit, EntryOfLegend, OfSamples> values;
  Needs needs = Needs::nothing;
  OfCorners of_corners = OfCorners::nothing;
  // Makes the legend of the ids; `scene` must outlive it. Null if the values are not ids.
  std::unique_ptr<LegendEntries> (*legend)(const Scene& scene) = nullptr;

  // Null for a channel of first hits.
  const OfSamples* of_samples() const { return std::get_if<OfSamples>(&values); }
};

using Channel = const ChannelType*;
// Channels in the order of channel_types(), each at most once.
using Channels = std::vector<Channel>;

// All channels, in the order in which they are listed.
std::span<const ChannelType> channel_types();
// The names of all channels, or of `channels`: "depth, position, …".
std::string channel_names();
std::string channel_names(const Channels& channels);
// The channel of that name, which must exist.
Channel channel_named(std::string_view name);
// Parses a list such as "depth,normal" or "all". Error (bad_input) for an unknown name.
Channels parse_channels(const std::string& list);

bool contains(const Channels& channels, Channel channel);
Channels with(Channels channels, std::initializer_list<std::string_view> names);
bool any_of_first_hits(const Channels& channels);
bool any_needs(const Channels& channels, Needs what);
// The wanted channels that a scene has. Error (bad_input) for AOVs that its integrator does not make; these
// are left out if all are wanted.
Channels channels_of(const Scene& scene, Channels wanted);

// The names of the components in a channel's layer of an .exr: "normal.X" and so on. A last component that
// means nothing is left out.
std::vector<std::string> layer_components(Channel channel);
// The file of a channel: NAME.CHANNEL.ENDING for an output NAME.….
std::filesystem::path channel_file(std::filesystem::path output, Channel channel, std::string_view ending);
// The rows of a channel of first hits, each `width` pixels wide. `entries`: those of the channel's legend;
// null if it has none.
image::Image channel_image(Channel channel, std::span<const FirstHit> hits, int width,
                           const LegendEntries* entries);

}  // namespace eyeray::engine::film
