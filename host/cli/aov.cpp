#include "host/cli/aov.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "host/core/diagnostic.hpp"
#include "host/core/error.hpp"

namespace eyeray::cli {
namespace {

// docs/command-line.md says what each holds.
constexpr AovType types[] = {
    {.name = "depth",
     .channels = 1,
     .shown_as = FalseColor::depth,
     .values = [](const FirstHit& hit) { return Vec3(hit.t); }},
    {.name = "position",
     .channels = 3,
     .shown_as = FalseColor::position,
     .values = [](const FirstHit& hit) { return hit.position; }},
    {.name = "normal",
     .channels = 3,
     .shown_as = FalseColor::direction,
     .values = [](const FirstHit& hit) { return hit.normal; }},
    {.name = "uv",
     .channels = 3,
     .shown_as = FalseColor::position,
     .values = [](const FirstHit& hit) { return Vec3(hit.uv, 0); }},
    {.name = "primitive",
     .channels = 1,
     .shown_as = FalseColor::ids,
     .values = [](const FirstHit& hit) { return Vec3(hit.primitive); },
     .legend = legend_of_objects},
    {.name = "material",
     .channels = 1,
     .shown_as = FalseColor::ids,
     .values = [](const FirstHit& hit) { return Vec3(hit.material); },
     .legend = legend_of_materials},
    {.name = "hits",
     .channels = 1,
     .shown_as = FalseColor::scalar,
     .values = [](const render::FinishedRows& rows) -> const Image& { return rows.hits; }},
    {.name = "rays",
     .channels = 1,
     .shown_as = FalseColor::scalar,
     .values = [](const render::FinishedRows& rows) -> const Image& { return rows.rays_traced; }},
    {.name = "flags",
     .channels = 1,
     .shown_as = FalseColor::scalar,
     .values = [](const render::FinishedRows& rows) -> const Image& { return rows.flagged; }},
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

bool need_first_hits(const std::vector<Aov>& aovs) {
  return std::ranges::any_of(aovs, &AovType::is_of_first_hits);
}

Image aov_image(Aov aov, std::span<const FirstHit> hits, int width) {
  const ValueOfHit value_of = std::get<ValueOfHit>(aov->values);
  Image image(width, int(hits.size()) / width, aov->channels);
  CHECK_EQ(hits.size() * size_t(aov->channels), image.sample_count());
  float* sample = image.samples().data();
  for (const FirstHit& hit : hits) {
    const Vec3 value = value_of(hit);
    for (int channel = 0; channel < aov->channels; ++channel) *sample++ = float(value[channel]);
  }
  return image;
}

}  // namespace eyeray::cli
