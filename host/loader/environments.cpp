#include "host/loader/environments.hpp"

#include <algorithm>
#include <tuple>

#include "host/lights/make.hpp"
#include "host/lights/sky.hpp"
#include "host/loader/kinds.hpp"

namespace eyeray::engine::loader {

using reading::Key, reading::KeyType;

namespace {

constexpr double brightest = 1e15;
// Limit on texels: each takes 16 bytes on the device, and their numbers must be valid indices.
constexpr int64_t most_texels = int64_t{1} << 26;

constexpr std::string_view image_manual =
    R"(A picture of the light from all directions: `.hdr`, `.exr` or `.pfm`, equirectangular, as most HDRIs are. Its
centre is in direction −z, the part to the right of it in +x, and its top is up. It is interpolated
bilinearly. A path samples directions in proportion to their brightness.

```
[environment]
image = "sky.hdr"
rotate = 90
```
)";

constexpr Key keys_of_image[] = {
    {.name = "image", .type = KeyType::string, .doc = "Name of the file, relative to this scene file."},
    {.name = "scale",
     .type = KeyType::color,
     .doc = "Factor for the picture's light, one for all channels or one for each.",
     .fallback = "1"},
    {.name = "rotate",
     .type = KeyType::number,
     .doc = "Rotation about y, in degrees, counter-clockwise seen from above.",
     .fallback = "0"},
};

// A description of wrong texels, or "".
std::string fault_of(const image::Image& image) {
  int64_t wrong = 0;
  int x = 0, y = 0;
  float value = 0;
  for (int row = 0; row < image.height(); ++row)
    for (int column = 0; column < image.width(); ++column)
      for (int c = 0; c < 3; ++c) {
        const float sample = image.pixel(column, row)[c];
        if (sample >= 0 && double(sample) <= brightest) continue;
        if (wrong++ == 0) std::tie(x, y, value) = std::tuple(column, row, sample);
      }
  if (wrong == 0) return "";
  return fmt::format(
      "{} value{} of the picture {} out of range: light must be from 0 to {:g}; the first is {:g}, in column "
      "{} of row {}",
      wrong, wrong == 1 ? "" : "s", wrong == 1 ? "is" : "are", brightest, value, x, y);
}

Surroundings parse_image(reading::TableReader& table, const reading::ValueSources& sources,
                         DiagnosticLog& log) {
  if (!table.valid("image")) return Surroundings();
  if (!sources.images) return table.error("image", "only a scene in a file can have images"), Surroundings();
  std::optional<image::Image> image =
      sources.images->load_light(table.string("image"), table.position("image"));
  if (!image || table.failed()) return Surroundings();
  if (const int64_t texels = int64_t{image->width()} * image->height(); texels > most_texels)
    return table.error("image", fmt::format("the picture has {} × {} texels; an environment has at most {}",
                                            image->width(), image->height(), most_texels)),
           Surroundings();
  const Vec3 scale = table.color("scale");
  for (size_t i = 0; i < image->sample_count(); ++i)
    image->samples()[i] = float(double(image->samples()[i]) * scale[int(i % 3)]);
  if (const std::string fault = fault_of(*image); !fault.empty())
    return table.error("image", fault), Surroundings();
  auto environment = std::make_shared<EnvironmentMap>(std::move(*image), table.number("rotate") / 360);
  if (!environment->cells().lit())
    log.warning(table.position("image"), "the environment is black: it lights nothing");
  return {environment, nullptr};
}

constexpr EnvironmentType of_image{
    .name = "image", .manual = image_manual, .keys = keys_of_image, .parse = parse_image};

constexpr std::string_view sky_manual =
    R"(A clear sky over a round, matte ground, with the sun as a light of an angle of 0.533°. The sky is the light
that Hillaire's atmosphere scatters, with single and multiple scattering. Above the atmosphere, a surface
perpendicular to the sun receives as much light as from a directional light with `intensity = 1`.

```
[environment]
type = "sky"
sun = [0.3, 0.5, -1]
```
)";

constexpr Key keys_of_sky[] = {
    {.name = "sun", .type = KeyType::vec3, .doc = "Direction towards the sun, of any length but 0."},
    {.name = "ground",
     .type = KeyType::color,
     .doc = "Share of light that the ground scatters. The ground is seen below the horizon.",
     .fallback = "0.3",
     .max = 1},
    {.name = "scale",
     .type = KeyType::color,
     .doc = "Factor for the light of sky and sun, one for all channels or one for each.",
     .fallback = "1"},
};

Surroundings parse_sky(reading::TableReader& table, const reading::ValueSources&, DiagnosticLog& log) {
  const Vec3 sun = table.vec3("sun");
  if (table.valid("sun") && !(glm::length(sun) > 1e-15)) table.error("sun", "`sun` has no length");
  if (const Vec3 scale = table.color("scale"); std::max({scale.x, scale.y, scale.z}) > 1e9)
    table.error("scale", "`scale` must be at most 1e9");
  if (table.failed()) return {};
  const lights::Sky sky =
      lights::make_sky({glm::normalize(sun), table.color("ground"), table.color("scale")});
  if (!sky.map->cells().lit()) log.warning(table.position(), "the environment is black: it lights nothing");
  return {sky.map, sky.sun ? lights::make_light(*sky.sun) : nullptr};
}

constexpr EnvironmentType of_sky{
    .name = "sky", .manual = sky_manual, .keys = keys_of_sky, .parse = parse_sky};

}  // namespace

std::span<const EnvironmentType* const> environment_types() {
  static constexpr const EnvironmentType* types[] = {&of_image, &of_sky};
  return types;
}

std::span<const Key> environment_keys() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const EnvironmentType* type : environment_types()) all.push_back(type->name);
    return all;
  }();
  static const Key keys[] = {
      {.name = "type",
       .type = KeyType::choice,
       .doc = "Kind; see below.",
       .fallback = "\"image\"",
       .choices = names},
      {.name = "share",
       .type = KeyType::number,
       .doc = "Probability with which `path` samples the environment rather than a light, in a scene that "
              "has both.",
       .fallback = "0.5",
       .min = 0,
       .max = 1,
       .above_min = true,
       .below_max = true},
  };
  return keys;
}

Surroundings read_environment(const Section& section, const toml::table* table,
                              const reading::ValueSources& sources, DiagnosticLog& log) {
  if (!table) return {};
  auto [type, reader] = read_kind(section, table, environment_types(), sources, log);
  Surroundings around = type ? type->parse(reader, sources, log) : Surroundings();
  if (around.map) around.map->share = reader.number("share");
  return around;
}

}  // namespace eyeray::engine::loader
