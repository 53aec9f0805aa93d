// Scenes that nobody would write: either the loader reports their faults, or they render.
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <mutex>

#include "frames.hpp"
#include "generator.hpp"
#include "host/core/parallel_for.hpp"
#include "host/loader/scene_file.hpp"
//
#include "tests/support/amount.hpp"
#include "tests/support/empty_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::test;

namespace {

// Makes a scene `width` × `height` pixels small, with a depth at which trees of rays end, and with few
// photons.
Scene shrunk(Scene scene, int width, int height) {
  scene.image.width = width;
  scene.image.height = height;
  scene.image.samples = std::min(scene.image.samples, 4);
  scene.render.max_depth = std::min(scene.render.max_depth, 6);
  scene.render.photons = std::min(scene.render.photons, 256);
  return scene;
}

// The number of scenes that fail, and the texts of the first, each with its reason.
class Failures {
 public:
  void add(const std::string& why, const std::string& text) {
    const std::lock_guard lock(mutex_);
    ++count_;
    if (count_ <= 3) shown_ += why + "\n" + text + "\n";
  }
  int count() const { return count_; }
  const std::string& shown() const { return shown_; }

 private:
  std::mutex mutex_;
  int count_ = 0;
  std::string shown_;
};

// The reason why an InputError does not help its reader; empty if it does.
std::string why_useless(const InputError& error) {
  if (error.diagnostics().empty()) return "no diagnostic";
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    if (diagnostic.position.line < 1 || diagnostic.position.column < 1)
      return "no position: " + diagnostic.message;
    if (diagnostic.message.empty()) return "no message";
  }
  return "";
}

// The text of extreme scene `i`, and the scene as small as it is rendered; InputError if the loader refuses
// it.
std::string extreme_text(int i) {
  Random random{uint64_t(i) + 10'000 * seed()};
  return random_scene_text(random,
                           {std::array{0.01, 0.05, 0.2, 0.4}[size_t(i) % 4], i % 3 > 0 || i % 4 == 3});
}
Scene extreme_scene(const std::string& text) {
  return shrunk(parse_scene(text, "scene.toml"), 8, 6);
}

// True if nothing is unexplained. A picture of 432 pixels that shows only one grazing patch has more
// explained pixels than any sensible scene.
bool agree(const ReferenceComparison& comparison) {
  const auto sound = [](const Tally& tally) {
    return tally.unexplained == 0 && tally.explained_pixels() <= 16;
  };
  return sound(comparison.first_hits) && sound(comparison.counts) && sound(comparison.colors);
}

}  // namespace

TEST_CASE("a scene with extreme values gives a clear error or a sound picture") {
  const int count = test::amount(2'000, 10'000, 10'000);
  Failures failures;
  std::atomic<int> refused = 0, rendered = 0, with_hits = 0, reached_iteration_limit = 0;
  parallel_for(0, count, [&](int i) {
    const std::string text = extreme_text(i);
    try {
      const Scene scene = extreme_scene(text);
      for (const Backend backend : {Backend::twin, Backend::reference}) {
        const Frame frame = render_frame(scene, backend);
        Soundness soundness = inspect(frame);
        // The scene itself causes these flags, and they are reported: media in media; a patch that is 1e12
        // wide and bent within 1.
        reached_iteration_limit += bool(soundness.flags & iteration_limit);
        soundness.flags &= ~(media_overflow | iteration_limit);
        soundness.flagged_pixels = 0;
        if (!soundness.ok())
          failures.add(fmt::format("{} {}: {}", i, backend_names[int(backend)], describe(soundness)), text);
        with_hits +=
            std::ranges::any_of(frame.first_hits, [](const FirstHit& hit) { return hit.primitive >= 0; });
      }
      ++rendered;
    } catch (const InputError& error) {
      ++refused;
      const std::string why = why_useless(error);
      if (!why.empty()) failures.add(fmt::format("{}: {}", i, why), text);
    } catch (const Error& error) {
      // Only the whole scene shows this error: the eye is inside too many media.
      ++refused;
      if (error.code() != ExitCode::bad_input) failures.add(fmt::format("{}: {}", i, error.what()), text);
    }
  });
  MESSAGE(fmt::format("{} refused, {} rendered, in {} of which something is seen; {} times out of steps",
                      refused.load(), rendered.load(), with_hits.load() / 2, reached_iteration_limit.load()));
  INFO(failures.shown());
  CHECK(failures.count() == 0);
  CHECK(refused > count / 4);
  CHECK(rendered > count / 16);
  CHECK(with_hits > count / 20);
  CHECK(reached_iteration_limit < count / 100);
}

// The formula's gradient in the world is so short that its squares underflow.
TEST_CASE("a formula in a box 1e12 wide has normals") {
  const Scene scene = parse_scene(R"(
image = { width = 8, height = 6 }
[camera]
up = [1.7, -1e15, 0]
fov = 179.99999982
fov_axis = "horizontal"
[[material]]
name = "mirror"
type = "mirror"
[[implicit]]
ready = "rounded-box"
min = [-1e12, -1e12, -1e12]
max = [1, 0, 0]
material = "mirror"
)",
                                  "scene.toml");
  const Frame frame = render_frame(scene, Backend::twin);
  CHECK(std::ranges::any_of(frame.first_hits, [](const FirstHit& hit) { return hit.primitive >= 0; }));
  const Soundness soundness = inspect(frame);
  INFO(describe(soundness));
  CHECK(soundness.infinite == 0);
}

// A direction that the coat chooses below the body's horizon has a density, but contributes no light.
TEST_CASE("a path that contributes no light has a colour after a flight through fog") {
  for (const std::string integrator : {"path", "sppm"}) {
    CAPTURE(integrator);
    Scene scene = parse_scene("render = { integrator = \"" + integrator + "\" }\n" + R"(
image = { width = 16, height = 12, samples = 16 }
medium = { scattering = 0.1 }
[camera]
eye = [0, 1, 3]
[[light]]
type = "point"
position = [1, 3, 1]
falloff = "inverse_square"
[[material]]
name = "lacquer"
type = "principled"
coat = 1
coat_roughness = 0.6
coat_normal = [1, 0.5, 0.6]
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "lacquer"
[[disk]]
center = [0, -1, 0]
normal = [0, 1, 0]
radius = 3
material = "lacquer"
)",
                              "scene.toml");
    scene.render.photons = 1024;
    scene.render.photon_radius = 0.5;
    const Soundness soundness = inspect(render_frame(scene, Backend::reference));
    INFO(describe(soundness));
    CHECK(soundness.ok());
  }
}

TEST_CASE("extreme scenes: the GPU and the twin agree, bit by bit") {
  const int count = test::amount(4, 16, 16);
  int compared = 0;
  for (int i = 0; compared < count; ++i) {
    const std::string text = extreme_text(i);
    try {
      const Scene scene = extreme_scene(text);
      const Frame twin = render_frame(scene, Backend::twin);
      if (std::ranges::none_of(twin.first_hits, [](const FirstHit& hit) { return hit.primitive >= 0; }))
        continue;
      ExecutorOptions options;
      options.gpu.constants = compared % 2 == 0;
      const ExactComparison bits = compare_exactly(render_frame(scene, Backend::gpu, options), twin);
      INFO(i, ": ", text);
      CHECK(bits.different_pixels == 0);
      ++compared;
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::bad_input);
    }
  }
}

TEST_CASE("random scenes: the twin agrees with the reference, the GPU with the twin") {
  const int count = test::amount(60, 300, 300);
  Failures failures;
  int compared = 0, explained = 0, creases = 0, on_gpu = 0;
  for (int i = 0; compared < count; ++i) {
    Random random{uint64_t(i) + 1'000'000};
    const std::string text = random_scene_text(random, {});
    Scene scene = test::empty_scene();
    try {
      scene = shrunk(parse_scene(text, "scene.toml"), 24, 18);
      scene.image.samples = 1;
    } catch (const InputError&) {
      continue;
    }
    if (scene.shapes.empty()) continue;
    ++compared;
    const Frame twin = render_frame(scene, Backend::twin);
    const ReferenceComparison comparison = test::compare_with_reference(scene, twin);
    explained += int(comparison.colors.explained_pixels());
    if (comparison.first_hits.passes() && comparison.colors.unexplained == 1) {
      ++creases;
    } else if (!agree(comparison)) {
      const auto line = [](const Tally& t) {
        return fmt::format("{} explained, {} unexplained, worst at {},{} ({:.3g} tolerances, {})",
                           t.explained_pixels(), t.unexplained, t.worst.pixel.x, t.worst.pixel.y,
                           t.worst.excess, name(t.worst.seam));
      };
      failures.add(fmt::format("{}: B {}; C {}", i, line(comparison.colors), line(comparison.first_hits)),
                   text);
    }
    if (compared % 10 != 0) continue;
    ++on_gpu;
    ExecutorOptions options;
    options.gpu.constants = on_gpu % 2 == 0;
    const ExactComparison bits = compare_exactly(render_frame(scene, Backend::gpu, options), twin);
    if (!bits.passes(0))
      failures.add(fmt::format("{}: {} pixels differ in their bits", i, bits.different_pixels), text);
  }
  MESSAGE(fmt::format("{} compared, {} on the GPU; {} pixels explained, {} in creases", compared, on_gpu,
                      explained, creases));
  INFO(failures.shown());
  CHECK(failures.count() == 0);
  // In a crease, a ray may start beyond the other surface, because float32 must step off its own surface by
  // some 1e-6 of its size. Here that affects about one pixel of a million.
  CHECK(creases <= 1);
}
