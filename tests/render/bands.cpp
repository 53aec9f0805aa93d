// Pictures that are rendered a band of rows at a time.
#include "fake_executor.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/support/ball_over_floor.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::render;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::test;

namespace {

const std::string glass_over_floor = ball_over_floor(
    "width = 37\nheight = 29\nsamples = 4\npattern = \"jittered\"", "type = \"dielectric\"\nior = 1.5");

RenderOptions in_bands(const Scene& scene, int rows, Rect crop = {}) {
  RenderOptions options;
  options.crop = crop;
  options.first_hits = true;
  options.band_bytes = band_of_rows(scene, rows);
  return options;
}

}  // namespace

TEST_CASE("bands make the same picture, bit by bit, with every executor") {
  const Scene scene = parse_scene(glass_over_floor, "scene.toml");
  for (const Backend backend : {Backend::gpu, Backend::twin, Backend::reference}) {
    const auto executor = make_executor(backend, scene, {});
    const Rendering whole = render::render(scene, *executor, in_bands(scene, 29));
    REQUIRE(whole.bands == 1);
    for (const int rows : {1, 5, 28}) {
      CAPTURE(int(backend));
      CAPTURE(rows);
      const Rendering banded = render::render(scene, *executor, in_bands(scene, rows));
      CHECK(banded.bands == (29 + rows - 1) / rows);
      CHECK(same_rendering(banded, whole));
      int different = 0;
      for (size_t i = 0; i < whole.first_hits.size(); ++i) {
        different += banded.first_hits[i].t != whole.first_hits[i].t ||
                     banded.first_hits[i].primitive != whole.first_hits[i].primitive;
      }
      CHECK(different == 0);
    }
  }
}

TEST_CASE("rows are delivered from the top down, each once, in a crop too") {
  const Scene scene = scene_of(40, 30, 4);
  const Rect crop{3, 5, 20, 21};
  for (const int rows : {1, 4, 100}) {
    FakeExecutor executor;
    RenderOptions options = in_bands(scene, rows, crop);
    options.band_bytes = size_t(rows) * 20 * sizeof(film::PixelTotals);
    options.channels = film::parse_channels("hits");
    int next = 0;
    const RenderTotals totals = render_rows(scene, executor, options, [&](const film::Rows& finished) {
      CHECK(finished.first == next);
      CHECK(finished.color.width() == 20);
      next += finished.color.height();
      // The mean of the fake executor's formula: hits are the row plus the number of the sample.
      CHECK(*finished[options.channels[0]].pixel(7, 0) == float(crop.y + finished.first) + 1.5f);
    });
    CHECK(next == 21);
    CHECK(totals.bands == (rows == 100 ? 1 : (21 + rows - 1) / rows));
    CHECK(totals.rays == 20u * 21u * (1 + 2 + 3 + 4));
    CHECK(totals.samples_done == 4);
    CHECK(totals.samples_taken == 20u * 21u * 4u);
    CHECK(totals.flags == stack_overflow);
    CHECK(totals.flagged_pixels == 20u * 21u / 5);
  }
}

TEST_CASE("progress reports the band, the sample, and the share of the work done") {
  const Scene scene = scene_of(10, 7, 4);
  FakeExecutor executor;
  RenderOptions options = in_bands(scene, 3);
  std::vector<std::pair<int, int>> seen;
  uint64_t done = 0;
  options.progress = [&](const Progress& progress) {
    seen.emplace_back(progress.band, progress.sample);
    CHECK(progress.bands == 3);
    CHECK(progress.samples == 4);
    CHECK(progress.samples_total == 280);
    CHECK(progress.samples_done > done);
    done = progress.samples_done;
  };
  render::render(scene, executor, options);
  CHECK(done == 280);
  REQUIRE(seen.size() == 12);
  CHECK(seen.front().first == 0);
  CHECK(seen[5] == std::pair(1, 2));
  CHECK(seen.back() == std::pair(2, 3));
}

TEST_CASE("an interrupted picture of several bands is empty") {
  const Scene scene = scene_of(10, 7, 4);
  for (const int stop : {0, 3, 4, 11}) {
    FakeExecutor executor([&](int call) { return call != stop; });
    const Rendering part = render::render(scene, executor, in_bands(scene, 3));
    CHECK(part.interrupted);
    CHECK(part.samples_done == 0);
    CHECK(part.color.sample_count() == 0);
    CHECK(part.first_hits.empty());
  }
  // If there is one band, the picture is whole and only noisier.
  FakeExecutor executor([](int call) { return call != 3; });
  const Rendering part = render::render(scene, executor, in_bands(scene, 7));
  CHECK(part.interrupted);
  CHECK(part.samples_done == 3);
  CHECK(*part.hits.pixel(2, 6) == 7.0f);
}
