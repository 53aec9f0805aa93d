#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host/core/error.hpp"
#include "host/film/channel.hpp"

namespace eyeray::engine::film {

std::vector<std::string> layer_components(Channel channel) {
  std::array<std::string_view, 3> components = channel->component_names;
  if (components[0].empty() && channel->components == 1) components = {"V"};
  if (components[0].empty()) components = {"X", "Y", "Z"};
  std::vector<std::string> names;
  for (const std::string_view component : components)
    if (!component.empty()) names.push_back(fmt::format("{}.{}", channel->name, component));
  return names;
}

std::filesystem::path channel_file(std::filesystem::path output, Channel channel, std::string_view ending) {
  return output.replace_extension(fmt::format("{}.{}", channel->name, ending));
}

image::Image channel_image(Channel channel, std::span<const FirstHit> hits, int width,
                           const LegendEntries* entries) {
  image::Image image(width, int(hits.size()) / width, channel->components);
  CHECK_EQ(hits.size() * size_t(channel->components), image.sample_count());
  float* sample = image.samples().data();
  if (const ValueOfHit* value_of = std::get_if<ValueOfHit>(&channel->values)) {
    for (const FirstHit& hit : hits) {
      const Vec3 value = (*value_of)(hit);
      for (int i = 0; i < channel->components; ++i) *sample++ = float(value[i]);
    }
  } else {
    for (const FirstHit& hit : hits) *sample++ = hit.primitive < 0 ? -1.0f : float(entries->of(hit));
  }
  return image;
}

}  // namespace eyeray::engine::film
