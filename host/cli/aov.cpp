#include "host/cli/aov.hpp"

#include <algorithm>
#include <array>

#include "host/core/diagnostic.hpp"
#include "host/core/error.hpp"

namespace eyeray::cli {
namespace {

struct AovType {
  std::string_view name;
  int channels;
  FalseColor shown_as;
};

// In the order of the enumeration.
constexpr std::array<AovType, 8> types{{
    {"depth", 1, FalseColor::depth},
    {"position", 3, FalseColor::position},
    {"normal", 3, FalseColor::direction},
    {"uv", 3, FalseColor::position},
    {"primitive", 1, FalseColor::ids},
    {"material", 1, FalseColor::ids},
    {"hits", 1, FalseColor::scalar},
    {"flags", 1, FalseColor::scalar},
}};

const AovType& type_of(Aov aov) {
  return types[size_t(aov)];
}

std::array<double, 3> values(Aov aov, const FirstHit& hit) {
  switch (aov) {
    case Aov::depth:
      return {hit.t};
    case Aov::position:
      return {hit.position.x, hit.position.y, hit.position.z};
    case Aov::normal:
      return {hit.normal.x, hit.normal.y, hit.normal.z};
    case Aov::uv:
      return {hit.uv.x, hit.uv.y, 0};
    case Aov::primitive:
      return {double(hit.primitive)};
    case Aov::material:
      return {double(hit.material)};
    case Aov::hits:
    case Aov::flags:
      break;
  }
  return {};
}

}  // namespace

std::string_view aov_name(Aov aov) {
  return type_of(aov).name;
}

std::vector<Aov> parse_aovs(const std::string& list) {
  std::vector<Aov> aovs;
  std::vector<std::string_view> names;
  for (const AovType& type : types) names.push_back(type.name);
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    const std::string name = list.substr(begin, end - begin);
    begin = end + 1;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) {
      aovs.push_back(Aov(found - names.begin()));
    } else if (name == "all") {
      for (size_t i = 0; i < types.size(); ++i) aovs.push_back(Aov(i));
    } else {
      const std::string nearest = nearest_name(name, names);
      throw Error(ExitCode::bad_input, "no AOV '{}'{} There are {} and all", name,
                  nearest.empty() ? "." : fmt::format("; did you mean '{}'?", nearest),
                  fmt::join(names, ", "));
    }
  }
  std::sort(aovs.begin(), aovs.end());
  aovs.erase(std::unique(aovs.begin(), aovs.end()), aovs.end());
  return aovs;
}

bool is_of_first_hits(Aov aov) {
  return aov != Aov::hits && aov != Aov::flags;
}

bool need_first_hits(const std::vector<Aov>& aovs) {
  return std::any_of(aovs.begin(), aovs.end(), is_of_first_hits);
}

int aov_channels(Aov aov) {
  return type_of(aov).channels;
}

FalseColor aov_shown_as(Aov aov) {
  return type_of(aov).shown_as;
}

Image aov_image(Aov aov, std::span<const FirstHit> hits, int width) {
  CHECK(is_of_first_hits(aov));
  const int channels = type_of(aov).channels;
  Image image(width, int(hits.size()) / width, channels);
  CHECK_EQ(hits.size() * size_t(channels), image.sample_count());
  float* sample = image.samples().data();
  for (const FirstHit& hit : hits) {
    const std::array<double, 3> value = values(aov, hit);
    for (int channel = 0; channel < channels; ++channel) *sample++ = float(value[size_t(channel)]);
  }
  return image;
}

}  // namespace eyeray::cli
