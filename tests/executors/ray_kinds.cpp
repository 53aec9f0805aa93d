// Rays counted by their kind.
#include <algorithm>

#include "host/loader/scene_file.hpp"
#include "host/render/render.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::executors;

namespace {

const std::string stage = R"(
[image]
width = 40
height = 30
[camera]
eye = [0, 1, 6]
target = [0, 0.6, 0]
[render]
ambient = 0.2
[[light]]
type = "point"
position = [3, 6, 4]
intensity = 30
[[light]]
type = "directional"
direction = [1, -1, 0]
[[material]]
name = "floor"
type = "phong"
diffuse = 0.7
reflectance = 0.3
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "floor"
)";

// Enough spheres for a BVH and packets; and a box whose sides keep in the light that entered by its front.
std::string things(const std::string& material) {
  std::string centers;
  for (int i = 0; i < 40; ++i)
    centers +=
        "[" + std::to_string(0.4 * (i % 8) - 1.4) + ", " + std::to_string(0.3 + 0.4 * (i / 8)) + ", 0],";
  return "[[sphere]]\nradius = 0.2\nmaterial = \"" + material + "\"\nbatch = { center = [" + centers +
         "] }\n[[box]]\nmin = [-2.4, 0.2, 0.3]\nmax = [-1.6, 1.4, 0.9]\nmaterial = \"" + material + "\"\n";
}

std::vector<PixelSample> samples(const Scene& scene, Backend backend, const char* rays) {
  ExecutorOptions options;
  options.ray_kinds = true;
  options.gpu.profile.rays = rays;
  const Rect all{0, 0, scene.image.width, scene.image.height};
  std::vector<PixelSample> out(size_t(all.pixels()));
  REQUIRE(make_executor(backend, scene, options)->sample(all, 0, out));
  return out;
}

RayCounts counted(std::span<const PixelSample> samples) {
  RayCounts counts;
  for (const PixelSample& sample : samples) counts.add(sample);
  return counts;
}

}  // namespace

TEST_CASE(
    "GPU and twin count each pixel's rays of each kind alike, in wavefronts too, the reference nearly so" *
    doctest::test_suite("long")) {
  for (const std::string material : {"glass", "floor"}) {
    CAPTURE(material);
    const Scene scene = parse_scene(stage + things(material), "scene.toml");
    const auto twin = samples(scene, Backend::twin, "");
    for (const char* rays : {"packets", "lanes"}) {
      CAPTURE(rays);
      const auto gpu = samples(scene, Backend::gpu, rays);
      CHECK(std::ranges::equal(gpu, twin, [](const PixelSample& a, const PixelSample& b) {
        return a.rays == b.rays && a.hits == b.hits && a.flags == b.flags && a.reflected == b.reflected &&
               a.refracted == b.refracted && a.total_reflections == b.total_reflections;
      }));
    }
    const RayCounts counts = counted(twin), reference = counted(samples(scene, Backend::reference, ""));
    const bool glass = material == "glass";
    CHECK(counts.eye == 1200);
    CHECK(counts.eye_hits == reference.eye_hits);
    CHECK(counts.reflected > 500);
    CHECK((counts.refracted > 500) == glass);
    CHECK((counts.total_reflections > 0) == glass);
    CHECK(counts.shadow > 1000);
    const auto near = [](uint64_t a, uint64_t b) { return std::max(a, b) - std::min(a, b) <= 3 + a / 200; };
    CHECK(near(counts.reflected, reference.reflected));
    CHECK(near(counts.refracted, reference.refracted));
    CHECK(near(counts.total_reflections, reference.total_reflections));
    CHECK(near(counts.shadow, reference.shadow));
  }
}

TEST_CASE("each pixel's ray kinds are the means of its samples, in bands too") {
  Scene scene = parse_scene(stage + things("glass"), "scene.toml");
  scene.image.samples = 3;
  ExecutorOptions options;
  options.ray_kinds = true;
  const auto executor = make_executor(Backend::twin, scene, options);
  const Rect all{0, 0, scene.image.width, scene.image.height};
  std::vector<PixelSample> samples[3];
  for (uint32_t i = 0; i < 3; ++i) {
    samples[i].resize(size_t(all.pixels()));
    REQUIRE(executor->sample(all, i, samples[i]));
  }
  render::RenderOptions how;
  how.channels = film::parse_channels("ray_kinds");
  const film::Channel kinds = how.channels[0];
  how.band_bytes = size_t(40 * 7) * sizeof(film::PixelTotals);
  size_t i = 0;
  const auto totals = render_rows(scene, *executor, how, [&](const film::Rows& rows) {
    for (size_t k = 0; k < rows.color.sample_count() / 3; ++k, ++i) {
      uint32_t reflected = 0, refracted = 0, rays = 0;
      for (const auto& of_index : samples) {
        reflected += of_index[i].reflected;
        refracted += of_index[i].refracted;
        rays += of_index[i].rays;
      }
      CHECK(rows[kinds].samples()[3 * k] == float(reflected / 3.0));
      CHECK(rows[kinds].samples()[3 * k + 1] == float(refracted / 3.0));
      CHECK(rows[kinds].samples()[3 * k + 2] == float((rays - 3 - reflected - refracted) / 3.0));
    }
  });
  CHECK(totals.bands > 1);
  CHECK(i == size_t(all.pixels()));

  how.channels.clear();
  render_rows(scene, *executor, how,
              [&](const film::Rows& rows) { CHECK_FALSE(film::contains(rows.channels, kinds)); });
}

TEST_CASE("a ray between two mirrors is reflected max_depth times") {
  const Scene scene = parse_scene(R"(
[image]
width = 8
height = 8
[camera]
eye = [0, 0, 0]
target = [0, 0, -1]
[render]
max_depth = 7
[[light]]
type = "directional"
direction = [0, 0, -1]
[[material]]
name = "mirror"
type = "mirror"
[[plane]]
point = [0, 0, -1]
normal = [0, 0, 1]
material = "mirror"
[[plane]]
point = [0, 0, 1]
normal = [0, 0, -1]
material = "mirror"
)",
                                  "scene.toml");
  for (const Backend backend : {Backend::gpu, Backend::twin, Backend::reference}) {
    const RayCounts counts = counted(samples(scene, backend, ""));
    CHECK(counts.eye == 64);
    CHECK(counts.eye_hits == 64);
    CHECK(counts.reflected == 64 * 7);
    CHECK(counts.refracted == 0);
    // Only four of the eight points cast shadow rays: those on the mirror that faces the light.
    CHECK(counts.shadow == 64 * 4);
  }
}

TEST_CASE("light that cannot leave glass counts as a total reflection, not as a refracted ray") {
  // From inside, past the critical angle of 41.8° everywhere.
  const Scene scene = parse_scene(R"(
[image]
width = 4
height = 4
[camera]
eye = [0, -1, 0]
target = [1, -0.5, 0]
up = [0, 1, 0]
fov = 10
[render]
max_depth = 3
[[light]]
type = "directional"
direction = [0, 1, 0]
[[material]]
name = "water"
type = "dielectric"
ior = 1.5
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "water"
)",
                                  "scene.toml");
  for (const Backend backend : {Backend::gpu, Backend::twin, Backend::reference}) {
    const RayCounts counts = counted(samples(scene, backend, ""));
    CHECK(counts.eye_hits == 16);
    CHECK(counts.reflected == 16);
    CHECK(counts.refracted == 0);
    CHECK(counts.total_reflections == 16);
  }
}

TEST_CASE("counts do not wrap where a picture's rays exceed 32 bits") {
  RayCounts counts;
  for (int i = 0; i < 3; ++i)
    counts.add({.rays = 0xffffffff, .hits = 1, .reflected = 0x80000000, .refracted = 0x7ffffff0});
  CHECK(counts.eye == 3);
  CHECK(counts.reflected == 3 * uint64_t{0x80000000});
  CHECK(counts.refracted == 3 * uint64_t{0x7ffffff0});
  CHECK(counts.total() == 3 * uint64_t{0xffffffff});
}
