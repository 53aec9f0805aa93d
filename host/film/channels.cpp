#include "host/film/channel.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/diagnostic.hpp"
#include "host/core/error.hpp"
#include "host/core/halves.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/luminance.hpp"

namespace eyeray::engine::film {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

// A count, or NaN if it is negative: then nothing was counted.
Vec3 count(int64_t value) {
  return Vec3(value < 0 ? no_value : double(value));
}

// A mean over the pixel's samples; 0 for a pixel that has none because it lies beside a shard's tile.
float mean_of(double sum, const PixelTotals& totals) {
  return float(sum / std::max(1u, unsigned{totals.samples}));
}

// Clamps a share: rounding and the weights of random paths may put it just outside 0 to 1.
float share(float value) {
  return std::clamp(value, 0.0f, 1.0f);
}

void add_reflected_and_refracted(const AddedSample& added, double* sums) {
  sums[0] += added.sample.reflected;
  sums[1] += added.sample.refracted;
}

// Adds to the sums of a mean over the first half of the samples.
void add_to_half(const Vec3& value, uint64_t number, double* sums) {
  if (in_first_half(number))
    for (int i = 0; i < 3; ++i) sums[i] += value[i];
}

void means_of_half(const PixelTotals& totals, const double* sums, float* values) {
  const auto samples = double(std::max(uint64_t{1}, first_half_of(totals.samples)));
  for (int i = 0; i < 3; ++i) values[i] = float(sums[i] / samples);
}

// The variance of the mean: s²/n.
void variances_of_means(const PixelTotals& totals, const double* sums, float* values) {
  const double n = totals.samples;
  for (int i = 0; i < 3; ++i)
    values[i] =
        n < 2 ? 0.0f : float(std::max(0.0, sums[i] - totals.color[i] * totals.color[i] / n) / (n * (n - 1)));
}

// A group of samples that does not count has a very bright one. So the square of its sum stands for the sum
// of its squares, which is not known.
double squares_without(double squares, double sum, const LeftOut& left) {
  return std::max(0.0, squares - sum * sum) * (left.others + left.samples) / left.others;
}

void means_of_three(const PixelTotals& totals, const double* sums, float* values) {
  for (int i = 0; i < 3; ++i) values[i] = mean_of(sums[i], totals);
}

// docs/command-line.md describes the contents of each channel.
constexpr ChannelType types[] = {
    {.name = "depth",
     .components = 1,
     .component_names = {"Z"},
     .shown_as = image::FalseColor::depth,
     .values = [](const FirstHit& hit) { return Vec3(hit.t); }},
    {.name = "position",
     .components = 3,
     .shown_as = image::FalseColor::position,
     .values = [](const FirstHit& hit) { return hit.position; }},
    {.name = "normal",
     .components = 3,
     .shown_as = image::FalseColor::direction,
     .values = [](const FirstHit& hit) { return hit.normal; }},
    {.name = "normal_geometric",
     .components = 3,
     .shown_as = image::FalseColor::direction,
     .values = [](const FirstHit& hit) { return hit.normal_geometric; }},
    {.name = "front",
     .components = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const FirstHit& hit) { return Vec3(hit.primitive < 0 ? no_value : hit.cosine > 0); }},
    {.name = "uv",
     .components = 3,
     .component_names = {"U", "V"},
     .shown_as = image::FalseColor::position,
     .values = [](const FirstHit& hit) { return Vec3(hit.uv, 0); }},
    {.name = "shape",
     .components = 1,
     .shown_as = image::FalseColor::ids,
     .values = EntryOfLegend{},
     .legend = legend_of_shapes},
    {.name = "primitive",
     .components = 1,
     .shown_as = image::FalseColor::ids,
     .values = [](const FirstHit& hit) { return Vec3(hit.primitive); },
     .legend = legend_of_primitives},
    {.name = "material",
     .components = 1,
     .shown_as = image::FalseColor::ids,
     .values = [](const FirstHit& hit) { return Vec3(hit.material); },
     .legend = legend_of_materials},
    {.name = "hits",
     .components = 1,
     .shown_as = image::FalseColor::scalar,
     .values = OfSamples{.mean = [](const PixelTotals& totals, const double*,
                                    float* values) { *values = mean_of(totals.hits, totals); }},
     .of_corners = OfCorners::mean},
    {.name = "bounces",
     .components = 1,
     .shown_as = image::FalseColor::scalar,
     .values = OfSamples{.sums = 2,
                         .add = add_reflected_and_refracted,
                         .mean =
                             [](const PixelTotals& totals, const double* sums, float* values) {
                               *values = mean_of(sums[0], totals) + mean_of(sums[1], totals);
                             }},
     .needs = Needs::ray_kinds,
     .of_corners = OfCorners::mean},
    {.name = "rays",
     .components = 1,
     .shown_as = image::FalseColor::scalar,
     .values = OfSamples{.mean = [](const PixelTotals& totals, const double*,
                                    float* values) { *values = mean_of(totals.rays, totals); }},
     .of_corners = OfCorners::mean},
    {.name = "ray_kinds",
     .components = 3,
     .component_names = {"reflected", "refracted", "shadow"},
     .shown_as = image::FalseColor::position,
     .values = OfSamples{.sums = 2,
                         .add = add_reflected_and_refracted,
                         .mean =
                             [](const PixelTotals& totals, const double* sums, float* values) {
                               values[0] = mean_of(sums[0], totals);
                               values[1] = mean_of(sums[1], totals);
                               values[2] =
                                   mean_of(double(totals.rays) - totals.samples - sums[0] - sums[1], totals);
                             }},
     .needs = Needs::ray_kinds,
     .of_corners = OfCorners::mean},
    {.name = "samples",
     .components = 1,
     .shown_as = image::FalseColor::scalar,
     .values = OfSamples{.mean = [](const PixelTotals& totals, const double*,
                                    float* values) { *values = float(totals.samples); }},
     .of_corners = OfCorners::mean},
    {.name = "noise",
     .components = 1,
     .shown_as = image::FalseColor::scalar,
     .values = OfSamples{
         .sums = 1,
         .add = [](const AddedSample& added,
                   double* sums) { *sums += luminance(added.sample.color) * luminance(added.sample.color); },
         .leave_out = [](const LeftOut& left,
                         double* sums) { *sums = squares_without(*sums, luminance(left.sum), left); }}},
    {.name = "brightest",
     .components = 1,
     .shown_as = image::FalseColor::depth,
     .values = OfSamples{
         .sums = 1,
         .add = [](const AddedSample& added,
                   double* sums) { *sums = std::max(*sums, double(float(luminance(added.sample.color)))); },
         .mean = [](const PixelTotals&, const double* sums, float* values) { *values = float(*sums); }}},
    {.name = "noisy",
     .components = 3,
     .component_names = {"R", "G", "B"},
     .shown_as = image::FalseColor::color,
     .values = OfSamples{.mean =
                             [](const PixelTotals& totals, const double*, float* values) {
                               for (int i = 0; i < 3; ++i) values[i] = mean_of(totals.color[i], totals);
                             }}},
    {.name = "variance",
     .components = 3,
     .component_names = {"R", "G", "B"},
     .shown_as = image::FalseColor::color,
     .values = OfSamples{.sums = 3,
                         .add =
                             [](const AddedSample& added, double* sums) {
                               for (int i = 0; i < 3; ++i)
                                 sums[i] += added.sample.color[i] * added.sample.color[i];
                             },
                         .mean = variances_of_means,
                         .leave_out =
                             [](const LeftOut& left, double* sums) {
                               for (int i = 0; i < 3; ++i)
                                 sums[i] = squares_without(sums[i], left.sum[i], left);
                             }}},
    {.name = "half",
     .components = 3,
     .component_names = {"R", "G", "B"},
     .shown_as = image::FalseColor::color,
     .values = OfSamples{.sums = 3,
                         .add = [](const AddedSample& added,
                                   double* sums) { add_to_half(added.sample.color, added.number, sums); },
                         .mean = means_of_half,
                         .leave_out =
                             [](const LeftOut& left, double* sums) {
                               if (!left.first_half) return;
                               for (int i = 0; i < 3; ++i)
                                 sums[i] += left.samples * left.mean[i] - left.sum[i];
                             }}},
    {.name = "albedo",
     .components = 3,
     .component_names = {"R", "G", "B"},
     .shown_as = image::FalseColor::color,
     .values = OfSamples{.sums = 3,
                         .add =
                             [](const AddedSample& added, double* sums) {
                               for (int i = 0; i < 3; ++i) sums[i] += added.auxiliary.albedo[i];
                             },
                         .mean = means_of_three},
     .needs = Needs::auxiliary},
    {.name = "shading_normal",
     .components = 3,
     .shown_as = image::FalseColor::direction,
     .values = OfSamples{.sums = 3,
                         .add =
                             [](const AddedSample& added, double* sums) {
                               for (int i = 0; i < 3; ++i) sums[i] += added.auxiliary.normal[i];
                             },
                         .mean = means_of_three},
     .needs = Needs::auxiliary},
    {.name = "half_albedo",
     .components = 3,
     .component_names = {"R", "G", "B"},
     .shown_as = image::FalseColor::color,
     .values = OfSamples{.sums = 3,
                         .add = [](const AddedSample& added,
                                   double* sums) { add_to_half(added.auxiliary.albedo, added.number, sums); },
                         .mean = means_of_half},
     .needs = Needs::auxiliary},
    {.name = "half_normal",
     .components = 3,
     .shown_as = image::FalseColor::direction,
     .values = OfSamples{.sums = 3,
                         .add = [](const AddedSample& added,
                                   double* sums) { add_to_half(added.auxiliary.normal, added.number, sums); },
                         .mean = means_of_half},
     .needs = Needs::auxiliary},
    {.name = "coverage",
     .components = 1,
     .shown_as = image::FalseColor::scalar,
     .values = OfSamples{
         .sums = 1,
         .add = [](const AddedSample& added, double* sums) { *sums += 1 - added.sample.background; },
         .mean = [](const PixelTotals& totals, const double* sums,
                    float* values) { *values = share(mean_of(*sums, totals)); }},
     .needs = Needs::coverage,
     .of_corners = OfCorners::mean},
    {.name = "half_coverage",
     .components = 1,
     .shown_as = image::FalseColor::scalar,
     .values = OfSamples{
         .sums = 3,
         .add = [](const AddedSample& added,
                   double* sums) { add_to_half(Vec3(1 - added.sample.background), added.number, sums); },
         .mean =
             [](const PixelTotals& totals, const double* sums, float* values) {
               float means[3];
               means_of_half(totals, sums, means);
               *values = share(means[0]);
             }},
     .needs = Needs::coverage},
    {.name = "nodes",
     .components = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const FirstHit& hit) { return count(hit.cost.nodes); },
     .needs = Needs::search_cost},
    {.name = "tests",
     .components = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const FirstHit& hit) { return count(hit.cost.tests); },
     .needs = Needs::search_cost},
    {.name = "flags",
     .components = 1,
     .shown_as = image::FalseColor::scalar,
     .values = OfSamples{.mean = [](const PixelTotals& totals, const double*,
                                    float* values) { *values = float(totals.flags); }},
     .of_corners = OfCorners::any_bit},
};

std::vector<std::string_view> names() {
  std::vector<std::string_view> all;
  for (const ChannelType& type : types) all.push_back(type.name);
  return all;
}

Channels in_order(Channels channels) {
  std::ranges::sort(channels);
  channels.erase(std::unique(channels.begin(), channels.end()), channels.end());
  return channels;
}

}  // namespace

std::span<const ChannelType> channel_types() {
  return types;
}

std::string channel_names() {
  return fmt::format("{}", fmt::join(names(), ", "));
}

std::string channel_names(const Channels& channels) {
  std::vector<std::string_view> some;
  for (const Channel each : channels) some.push_back(each->name);
  return fmt::format("{}", fmt::join(some, ", "));
}

Channel channel_named(std::string_view name) {
  const ChannelType* const found = std::ranges::find(types, name, &ChannelType::name);
  CHECK(found != std::end(types));
  return found;
}

Channels parse_channels(const std::string& list) {
  Channels channels;
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    const std::string name = list.substr(begin, end - begin);
    begin = end + 1;
    const ChannelType* found = std::ranges::find(types, name, &ChannelType::name);
    if (found != std::end(types)) {
      channels.push_back(found);
    } else if (name == "all") {
      for (const ChannelType& type : types) channels.push_back(&type);
    } else {
      const std::string nearest = nearest_name(name, names());
      throw Error(ExitCode::bad_input, "no AOV '{}'{} There are {} and all", name,
                  nearest.empty() ? "." : fmt::format("; did you mean '{}'?", nearest), channel_names());
    }
  }
  return in_order(std::move(channels));
}

bool contains(const Channels& channels, Channel channel) {
  return std::ranges::find(channels, channel) != channels.end();
}

Channels with(Channels channels, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) channels.push_back(channel_named(name));
  return in_order(std::move(channels));
}

bool any_of_first_hits(const Channels& channels) {
  return !std::ranges::all_of(channels, &ChannelType::of_samples);
}

bool any_needs(const Channels& channels, Needs what) {
  return std::ranges::find(channels, what, &ChannelType::needs) != channels.end();
}

Channels channels_of(const Scene& scene, Channels wanted) {
  const bool all = wanted.size() == std::size(types);
  const auto lacks = [&](Needs what, bool has, const char* sentence) {
    if (has || !any_needs(wanted, what)) return;
    if (!all) throw Error(ExitCode::bad_input, "{}", sentence);
    std::erase_if(wanted, [&](Channel each) { return each->needs == what; });
  };
  lacks(Needs::auxiliary, walks_at_random(scene.render.integrator),
        "only paths have the AOVs albedo and shading_normal: set integrator = \"path\" in [render], or "
        "request the AOV normal, which every integrator has");
  lacks(Needs::coverage, scene.image.transparent,
        "only transparent pictures have the AOV coverage: set transparent = true in [image]");
  return wanted;
}

}  // namespace eyeray::engine::film
