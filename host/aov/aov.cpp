#include "host/aov/aov.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "host/core/diagnostic.hpp"
#include "host/core/error.hpp"

namespace eyeray::aov {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

// A count, where there is one.
Vec3 count(int64_t value) {
  return Vec3(value < 0 ? no_value : double(value));
}

// Rays followed from surface to surface, of `kinds`.
image::Image bounces(const image::Image& kinds) {
  image::Image sums(kinds.width(), kinds.height(), 1);
  for (size_t i = 0; i < sums.sample_count(); ++i)
    sums.samples()[i] = kinds.samples()[3 * i] + kinds.samples()[3 * i + 1];
  return sums;
}

// docs/command-line.md says what each holds.
constexpr AovType types[] = {
    {.name = "depth",
     .channels = 1,
     .components = {"Z"},
     .shown_as = image::FalseColor::depth,
     .values = [](const FirstHit& hit) { return Vec3(hit.t); }},
    {.name = "position",
     .channels = 3,
     .shown_as = image::FalseColor::position,
     .values = [](const FirstHit& hit) { return hit.position; }},
    {.name = "normal",
     .channels = 3,
     .shown_as = image::FalseColor::direction,
     .values = [](const FirstHit& hit) { return hit.normal; }},
    {.name = "normal_geometric",
     .channels = 3,
     .shown_as = image::FalseColor::direction,
     .values = [](const FirstHit& hit) { return hit.normal_geometric; }},
    {.name = "front",
     .channels = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const FirstHit& hit) { return Vec3(hit.primitive < 0 ? no_value : hit.cosine > 0); }},
    {.name = "uv",
     .channels = 3,
     .components = {"U", "V"},
     .shown_as = image::FalseColor::position,
     .values = [](const FirstHit& hit) { return Vec3(hit.uv, 0); }},
    {.name = "shape",
     .channels = 1,
     .shown_as = image::FalseColor::ids,
     .values = EntryOfLegend{},
     .legend = legend_of_shapes},
    {.name = "primitive",
     .channels = 1,
     .shown_as = image::FalseColor::ids,
     .values = [](const FirstHit& hit) { return Vec3(hit.primitive); },
     .legend = legend_of_primitives},
    {.name = "material",
     .channels = 1,
     .shown_as = image::FalseColor::ids,
     .values = [](const FirstHit& hit) { return Vec3(hit.material); },
     .legend = legend_of_materials},
    {.name = "hits",
     .channels = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const render::FinishedRows& rows) { return rows.hits; }},
    {.name = "bounces",
     .channels = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const render::FinishedRows& rows) { return bounces(rows.kinds); },
     .needs = AovNeeds::ray_kinds},
    {.name = "rays",
     .channels = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const render::FinishedRows& rows) { return rows.rays_traced; }},
    {.name = "ray_kinds",
     .channels = 3,
     .components = {"reflected", "refracted", "shadow"},
     .shown_as = image::FalseColor::position,
     .values = [](const render::FinishedRows& rows) { return rows.kinds; },
     .needs = AovNeeds::ray_kinds},
    {.name = "samples",
     .channels = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const render::FinishedRows& rows) { return rows.samples; }},
    {.name = "noise",
     .channels = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const render::FinishedRows& rows) { return rows.noise; },
     .needs = AovNeeds::noise},
    {.name = "brightest",
     .channels = 1,
     .shown_as = image::FalseColor::depth,
     .values = [](const render::FinishedRows& rows) { return rows.brightest; },
     .needs = AovNeeds::brightest},
    {.name = "albedo",
     .channels = 3,
     .components = {"R", "G", "B"},
     .shown_as = image::FalseColor::color,
     .values = [](const render::FinishedRows& rows) { return rows.albedo; },
     .needs = AovNeeds::auxiliary},
    {.name = "shading_normal",
     .channels = 3,
     .shown_as = image::FalseColor::direction,
     .values = [](const render::FinishedRows& rows) { return rows.normal; },
     .needs = AovNeeds::auxiliary},
    {.name = "nodes",
     .channels = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const FirstHit& hit) { return count(hit.cost.nodes); },
     .needs = AovNeeds::search_cost},
    {.name = "tests",
     .channels = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const FirstHit& hit) { return count(hit.cost.tests); },
     .needs = AovNeeds::search_cost},
    {.name = "flags",
     .channels = 1,
     .shown_as = image::FalseColor::scalar,
     .values = [](const render::FinishedRows& rows) { return rows.flagged; }},
};

std::vector<std::string_view> names() {
  std::vector<std::string_view> all;
  for (const AovType& type : types) all.push_back(type.name);
  return all;
}

}  // namespace

std::span<const AovType> aov_types() {
  return types;
}

std::vector<std::string> layer_channels(Aov aov) {
  std::array<std::string_view, 3> components = aov->components;
  if (components[0].empty() && aov->channels == 1) components = {"V"};
  if (components[0].empty()) components = {"X", "Y", "Z"};
  std::vector<std::string> names;
  for (const std::string_view component : components)
    if (!component.empty()) names.push_back(fmt::format("{}.{}", aov->name, component));
  return names;
}

std::string aov_names() {
  return fmt::format("{}", fmt::join(names(), ", "));
}

std::vector<Aov> parse_aovs(const std::string& list) {
  std::vector<Aov> aovs;
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    const std::string name = list.substr(begin, end - begin);
    begin = end + 1;
    const AovType* found = std::ranges::find(types, name, &AovType::name);
    if (found != std::end(types)) {
      aovs.push_back(found);
    } else if (name == "all") {
      for (const AovType& type : types) aovs.push_back(&type);
    } else {
      const std::string nearest = nearest_name(name, names());
      throw Error(ExitCode::bad_input, "no AOV '{}'{} There are {} and all", name,
                  nearest.empty() ? "." : fmt::format("; did you mean '{}'?", nearest), aov_names());
    }
  }
  std::ranges::sort(aovs);
  aovs.erase(std::unique(aovs.begin(), aovs.end()), aovs.end());
  return aovs;
}

std::filesystem::path aov_file(std::filesystem::path output, Aov aov, std::string_view ending) {
  return output.replace_extension(fmt::format("{}.{}", aov->name, ending));
}

bool need_first_hits(const std::vector<Aov>& aovs) {
  return std::ranges::any_of(aovs, &AovType::is_of_first_hits);
}

bool any_needs(const std::vector<Aov>& aovs, AovNeeds what) {
  return std::ranges::find(aovs, what, &AovType::needs) != aovs.end();
}

image::Image aov_image(Aov aov, std::span<const FirstHit> hits, int width, const LegendEntries* entries) {
  image::Image image(width, int(hits.size()) / width, aov->channels);
  CHECK_EQ(hits.size() * size_t(aov->channels), image.sample_count());
  float* sample = image.samples().data();
  if (const ValueOfHit* value_of = std::get_if<ValueOfHit>(&aov->values)) {
    for (const FirstHit& hit : hits) {
      const Vec3 value = (*value_of)(hit);
      for (int channel = 0; channel < aov->channels; ++channel) *sample++ = float(value[channel]);
    }
  } else {
    for (const FirstHit& hit : hits) *sample++ = hit.primitive < 0 ? -1.0f : float(entries->of(hit));
  }
  return image;
}

}  // namespace eyeray::aov
