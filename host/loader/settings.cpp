#include "host/loader/settings.hpp"

#include <cmath>

#include "host/optics/temperature.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/sampler.hpp"

namespace eyeray::engine::loader {

using reading::Key, reading::KeyType;

namespace {

constexpr int64_t most_pixels = int64_t{1} << 28;

constexpr std::string_view light_samplers[] = {"automatic", "uniform", "power", "bvh"};
constexpr std::string_view triangle_methods[] = {"woop", "moller-trumbore"};
constexpr std::string_view group_storages[] = {"automatic", "instanced", "flat"};

constexpr std::string_view pixel_filters[] = {"box", "gaussian", "blackman-harris"};
constexpr double usual_filter_width = 3;

constexpr Key image_table[] = {
    {.name = "width",
     .type = KeyType::integer,
     .doc = "Width of the picture, in pixels.",
     .fallback = "640",
     .min = 1,
     .max = 65536},
    {.name = "height",
     .type = KeyType::integer,
     .doc = "Height of the picture, in pixels. The picture has at most 2^28 pixels.",
     .fallback = "480",
     .min = 1,
     .max = 65536},
    {.name = "samples",
     .type = KeyType::integer,
     .doc = "Samples per pixel. The default is 64 for the integrators `path` and `sppm`, and 1 for the "
            "others. `regular` and `jittered` use an n × n grid, so the number must be a square number.",
     .min = 1,
     .max = 65536,
     .optional = true},
    {.name = "pattern",
     .type = KeyType::choice,
     .doc = "Distribution of the samples in a pixel; see below. The default is `sobol` for the integrators "
            "`path` and `sppm`, and `regular` for the others.",
     .choices = sample_patterns,
     .optional = true},
    {.name = "filter",
     .type = KeyType::choice,
     .doc = "Reconstruction filter. `box`: the pixel's square. `gaussian` and `blackman-harris`: weighted "
            "towards the pixel's centre. Samples are drawn from the filter.",
     .fallback = "\"box\"",
     .choices = pixel_filters},
    {.name = "filter_width",
     .type = KeyType::number,
     .doc = "Full width of the filters `gaussian` and `blackman-harris`, in pixels; 3 when absent. "
            "`gaussian` is cut off at three standard deviations.",
     .min = 0,
     .max = 64,
     .above_min = true,
     .optional = true},
    {.name = "exposure",
     .type = KeyType::number,
     .doc = "Exposure of a .png file, in stops: light is multiplied by 2^exposure. `\"auto\"` measures the "
            "picture first, and makes its light 0.36 in the geometric mean, or less. Other formats store the "
            "light unchanged.",
     .fallback = "0",
     .min = -32,
     .max = 32,
     .word = "auto"},
    {.name = "tone",
     .type = KeyType::choice,
     .doc = "Tone mapping of a .png file, for light beyond 1. `\"none\"` cuts it off. `\"neutral\"` "
            "compresses it towards white, and keeps the colours of materials (Khronos PBR Neutral). "
            "`\"filmic\"` (Hable), `\"aces\"` (Hill's fit) and `\"agx\"` (Sobotka) look like film: they "
            "change all colours, and `agx` lets bright ones fade most.",
     .fallback = "\"none\"",
     .choices = image::tone_curves},
    {.name = "white_balance",
     .type = KeyType::number,
     .doc = "Colour temperature in kelvin of the light that a .png file shows as white: 2700 for bulbs, 5500 "
            "for the sun, 6500 for daylight. When absent, [1, 1, 1] is white.",
     .min = optics::coldest,
     .max = optics::hottest,
     .optional = true},
    {.name = "transparent",
     .type = KeyType::boolean,
     .doc = "Whether the picture has an alpha in place of its background, which then only lights the scene. "
            "Only .png and .exr files have one.",
     .fallback = "false"},
};

constexpr Key render_table[] = {
    {.name = "integrator",
     .type = KeyType::choice,
     .doc = "Algorithm that computes the light; see below.",
     .fallback = "\"whitted\"",
     .choices = integrator_names},
    {.name = "max_depth",
     .type = KeyType::integer,
     .doc = "Largest number of reflections and refractions in a row; 0 traces only camera rays and shadow "
            "rays. The default is 16 for the integrators `path` and `sppm`, and 8 for the others. Values "
            "above 64 are only for `path` and `sppm`.",
     .min = 0,
     .max = 1024,
     .optional = true},
    {.name = "min_throughput",
     .type = KeyType::number,
     .doc = "A reflected or refracted ray is not traced if its weight is below this value.",
     .fallback = "0.001",
     .min = 0,
     .max = 1},
    {.name = "seed",
     .type = KeyType::integer,
     .doc = "Seed of all random numbers.",
     .fallback = "0",
     .min = 0,
     .max = 4294967295},
    {.name = "light_sampler",
     .type = KeyType::choice,
     .doc = "How `path` chooses a light at a vertex. `\"uniform\"`: all lights are equally likely. "
            "`\"power\"`: by power. `\"bvh\"`: by a BVH of the lights, which accounts for distance and "
            "direction. `\"automatic\"`: `bvh` from 64 lights on, else `power`.",
     .fallback = "\"automatic\"",
     .choices = light_samplers},
    {.name = "denoise",
     .type = KeyType::boolean,
     .doc = "Whether to remove the noise of random paths from the finished picture. Only for `path` and "
            "`sppm`. `eyeray verify` compares noisy pictures.",
     .fallback = "false"},
    {.name = "photons",
     .type = KeyType::integer,
     .doc = "Number of photons that `sppm` emits for each sample.",
     .fallback = "131072",
     .min = 1,
     .max = 16777216},
    {.name = "photon_radius",
     .type = KeyType::number,
     .doc = "Radius in which the first sample of `sppm` gathers photons, in world units. When absent: the "
            "width of two pixels at the distance of the middle of all finite shapes.",
     .min = 0,
     .max = 1e9,
     .above_min = true,
     .optional = true},
    {.name = "triangle",
     .type = KeyType::choice,
     .doc = "Algorithm of triangle intersection; see [[triangle]].",
     .fallback = "\"woop\"",
     .choices = triangle_methods},
    {.name = "groups",
     .type = KeyType::choice,
     .doc = "Whether groups that are placed more than once are instanced or copied. `\"automatic\"` "
            "instances them where that saves much memory.",
     .fallback = "\"automatic\"",
     .choices = group_storages},
    {.name = "background",
     .type = KeyType::color,
     .doc = "Light that a ray sees if it hits nothing.",
     .fallback = "0"},
    {.name = "ambient",
     .type = KeyType::color,
     .doc = "Light that reaches every point from all directions.",
     .fallback = "0"},
};

constexpr Key verify_table[] = {
    {.name = "max_explained",
     .type = KeyType::number,
     .doc = "Largest share of pixels, for each gate, that may differ from the reference at discontinuities "
            "of the picture. 4 pixels may differ in any case. `eyeray verify --record` writes the value that "
            "the scene needs.",
     .fallback = "0.005",
     .min = 0,
     .max = 0.05},
};

void check_samples(reading::TableReader& table, int samples) {
  const int root = static_cast<int>(std::sqrt(static_cast<double>(samples)));
  if (root * root == samples) return;
  table.error("samples", fmt::format("`samples` must be a square number; the nearest to {} are {} and {}",
                                     samples, root * root, (root + 1) * (root + 1)));
}

ImageSettings image_defaults(IntegratorType integrator) {
  ImageSettings image;
  if (walks_at_random(integrator)) {
    image.samples = 64;
    image.pattern = SamplePattern::sobol;
  }
  return image;
}

}  // namespace

std::span<const Key> image_keys() {
  return image_table;
}
std::span<const Key> render_keys() {
  return render_table;
}

std::span<const Key> verify_keys() {
  return verify_table;
}

// The fallbacks of the tables' keys must equal the defaults of a Scene.
static_assert(ImageSettings{}.pattern == SamplePattern::regular);
static_assert(RenderSettings{}.integrator == IntegratorType::whitted);

ImageSettings read_image(reading::TableReader& table, IntegratorType integrator) {
  ImageSettings image = image_defaults(integrator);
  image.width = static_cast<int>(table.integer("width"));
  image.height = static_cast<int>(table.integer("height"));
  if (table.has("samples")) image.samples = static_cast<int>(table.integer("samples"));
  if (table.has("pattern")) image.pattern = static_cast<SamplePattern>(table.choice("pattern"));
  image.filter = static_cast<PixelFilter>(table.choice("filter"));
  if (image.filter != PixelFilter::box) {
    image.filter_width = table.has("filter_width") ? table.number("filter_width") : usual_filter_width;
  } else if (table.has("filter_width")) {
    table.error("filter_width", "`filter_width` is for filter = \"gaussian\" or \"blackman-harris\" only");
  }
  image.meters = table.is_word("exposure");
  image.tone.exposure = image.meters ? 0 : table.number("exposure");
  image.tone.curve = static_cast<image::ToneCurve>(table.choice("tone"));
  if (table.has("white_balance")) image.tone.white_balance = table.number("white_balance");
  image.transparent = table.boolean("transparent");
  if (sample_count_of(image.pattern) == SampleCount::square) check_samples(table, image.samples);
  const int64_t pixels = int64_t{image.width} * image.height;
  if (pixels > most_pixels) {
    table.error(table.has("width") ? "width" : "height",
                fmt::format("{} × {} is {} pixels; a picture has at most {} (16384 × 16384)", image.width,
                            image.height, pixels, most_pixels));
  }
  return image;
}

RenderSettings read_render(reading::TableReader& table) {
  RenderSettings render;
  render.integrator = static_cast<IntegratorType>(table.choice("integrator"));
  if (walks_at_random(render.integrator)) render.max_depth = 16;
  if (table.has("max_depth")) render.max_depth = static_cast<int>(table.integer("max_depth"));
  if (constexpr int most_waiting = 64; render.max_depth > most_waiting && !walks_at_random(render.integrator))
    table.error(
        "max_depth",
        fmt::format("`max_depth` must be at most {}, except for the integrators \"path\" and \"sppm\"",
                    most_waiting));
  render.min_throughput = table.number("min_throughput");
  render.seed = static_cast<uint32_t>(table.integer("seed"));
  render.light_sampler = static_cast<LightSampler>(table.choice("light_sampler"));
  if (sends_photons(render.integrator) && render.light_sampler == LightSampler::bvh)
    table.error("light_sampler", "`sppm` chooses lights by power, as its photons do, not by a BVH");
  render.photons = static_cast<int>(table.integer("photons"));
  if (table.has("photon_radius")) render.photon_radius = table.number("photon_radius");
  render.denoise = table.boolean("denoise");
  render.triangle_method = static_cast<TriangleMethod>(table.choice("triangle"));
  render.groups = static_cast<GroupStorage>(table.choice("groups"));
  render.background = table.color("background");
  render.ambient = table.color("ambient");
  return render;
}

VerifySettings read_verify(reading::TableReader& table) {
  return {.max_explained = table.number("max_explained")};
}

}  // namespace eyeray::engine::loader
