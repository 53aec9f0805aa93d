// Kernels that load the numbers of a scene's formulas.
#include <fmt/format.h>

#include "host/executors/executor.hpp"
#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
#include "tests/support/entries.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

// A colour, a surface with a declared slope, one that is searched by bounds, and a camera, each with
// parameters.
Scene scene_of(double size, double shade, double height, double radius, double zoom) {
  return loader::parse_scene(fmt::format(R"(
[image]
width = 40
height = 30
samples = 4
[render]
background = [0.5, 0.6, 0.7]
[camera]
type = "formula"
eye = [0, 0, 5]
target = [0, 0, 0]
code = "vec3 direction(vec2 place, vec2 lens) {{ return vec3(zoom * place, 1.0); }}"
parameters = {{ zoom = {4} }}
[[light]]
type = "point"
position = [2, 4, 5]
intensity = 60
[[material]]
name = "pattern"
type = "phong"
[material.diffuse.formula]
code = """
vec3 color(vec2 uv) {{
  float shades[3] = float[3](0.25, shade, 0.5);
  vec2 cell = floor(uv / size);
  float sum = 0.0;
  for (int i = 0; i < int(8.0 * size); ++i) sum += 0.125 * shade;
  return vec3(shades[int(mod(cell.x + cell.y, 3.0))], 0.5 * (1.0 - shade), sum);
}}"""
parameters = {{ size = {0}, shade = {1} }}
[[implicit]]
code = "float f(vec3 p) {{ return length(p) - height; }}"
parameters = {{ height = {2} }}
min = [-2, -1, -1]
max = [0, 1, 1]
lipschitz = 1
material = "pattern"
[[implicit]]
code = "float f(vec3 p) {{ return dot(p - vec3(1.0, 0.0, 0.0), p - vec3(1.0, 0.0, 0.0)) - radius * radius; }}"
parameters = {{ radius = {3} }}
min = [0, -1, -1]
max = [2, 1, 1]
material = "pattern"
)",
                                         size, shade, height, radius, zoom),
                             "scene.toml");
}

struct Specialised {
  std::string text;
  std::vector<uint32_t> numbers;
};

Specialised specialised(const Scene& scene) {
  expression::LoadedNumbers numbers;
  Specialisation specialisation;
  specialisation.constants = false;
  specialisation.formula_numbers = &numbers;
  std::string text = specialise(pack::pack(scene, {}), specialisation);
  return {std::move(text), numbers.words()};
}

std::vector<PixelSample> samples(const Scene& scene, Backend backend, bool formula_numbers) {
  ExecutorOptions options;
  options.gpu.constants = false;
  options.gpu.formula_numbers = formula_numbers;
  const Rect all{0, 0, scene.image.width, scene.image.height};
  std::vector<PixelSample> samples(size_t(all.pixels()));
  REQUIRE(make_executor(backend, scene, options)->sample(all, 1, samples));
  return samples;
}

}  // namespace

TEST_CASE("a kernel that loads the numbers of formulas suits other parameters too") {
  const Specialised first = specialised(scene_of(0.3, 0.7, 0.9, 0.8, 0.55));
  CHECK(first.text.find("#define FORMULA_NUMBERS") != std::string::npos);
  // The last scene's parameters include numbers that the formulas contain as well.
  for (const Scene& other : {scene_of(0.31, 0.65, 0.8, 0.85, 0.6), scene_of(0.25, 0.125, 0.5, 0.25, 3)}) {
    const Specialised second = specialised(other);
    CHECK(second.text == first.text);
    CHECK(second.numbers != first.numbers);
    CHECK(second.numbers.size() == first.numbers.size());
  }
}

TEST_CASE("loaded numbers give the same bits as numbers in the kernel's text") {
  for (const Scene& scene : {scene_of(0.3, 0.7, 0.9, 0.8, 0.55), scene_of(0.25, 0.125, 0.5, 0.25, 0.5)}) {
    const auto loaded = samples(scene, Backend::gpu, true);
    for (const auto& other : {samples(scene, Backend::gpu, false), samples(scene, Backend::twin, false)})
      CHECK(std::ranges::equal(loaded, other, [](const PixelSample& a, const PixelSample& b) {
        return a.color == b.color && a.flags == b.flags;
      }));
    CHECK(std::ranges::any_of(loaded,
                              [&](const PixelSample& sample) { return sample.color != loaded[0].color; }));
  }
}
