// Adaptive sampling: pixels take as many samples as they need.
#include "host/render/adaptive.hpp"

#include "fake_executor.hpp"
#include "host/render/checkpoint.hpp"
#include "host/scene/luminance.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::render;
using namespace eyeray::engine::test;

namespace {

constexpr double target = 0.05;

// Grey pixels of brightness 0.5: without noise on the left, and from column 40 on with noise of a known
// width.
class NoisyExecutor final : public FakeExecutor {
 public:
  using FakeExecutor::FakeExecutor;

  bool sample(const Grid& grid, uint32_t index, std::span<PixelSample> out,
              std::span<AuxiliarySample> auxiliaries) override {
    const Rect& tile = grid.area;
    if (!FakeExecutor::sample(tile, index, out, auxiliaries)) return false;
    for (int i = 0; i < tile.pixels(); ++i) {
      const int x = tile.x + i % tile.width, y = tile.y + i / tile.width;
      uint32_t hash = uint32_t(x) * 0x9E3779B9u ^ uint32_t(y) * 0x85EBCA6Bu ^ index * 0xC2B2AE35u;
      for (const int shift : {16, 13, 16}) hash = (hash ^ hash >> shift) * 0x45D9F3Bu;
      const double uniform = double(hash ^ hash >> 16) / 4294967296.0 - 0.5;
      out[size_t(i)].color = Vec3(0.5 + (x < 40 ? 0 : 0.9 * uniform));
    }
    return true;
  }
};

RenderOptions until(double noise, int rows, int width) {
  RenderOptions options;
  options.noise = noise;
  options.band_bytes = size_t(rows) * size_t(width) * sizeof(film::PixelTotals);
  return options;
}

}  // namespace

TEST_CASE("pixels stop at the first judgement, at the samples that their variance needs, or at the limit") {
  // A pixel needs (1.96 σ / (target · 0.51))² samples, where σ² = 0.9²/12, and stops at the next judgement.
  constexpr int wanted = 512;
  for (const int most : {16384, 300}) {
    CAPTURE(most);
    const Scene scene = scene_of(81, 45, most);
    NoisyExecutor executor;
    std::vector<int> samples;
    uint64_t shown = 0;
    RenderOptions options = until(target, 45, 81);
    options.progress = [&](const Progress& progress) {
      CHECK(progress.samples_done > shown);
      CHECK(progress.samples_done <= progress.samples_total);
      shown = progress.samples_done;
    };
    const RenderTotals totals = render_rows(scene, executor, options, [&](const film::Rows& rows) {
      for (const float value : rows[film::channel_named("samples")].samples()) samples.push_back(int(value));
    });
    REQUIRE(samples.size() == 81u * 45u);
    uint64_t sum = 0;
    for (int y = 0; y < 45; ++y) {
      for (int x = 0; x < 81; ++x) {
        const int taken = samples[size_t(y * 81 + x)];
        sum += uint64_t(taken);
        // A block beside noisy blocks waits for them.
        if (x < 32) CHECK(taken == 64);
        if (x >= 40) CHECK(taken == std::min(wanted, most));
      }
    }
    CHECK(totals.samples_taken == sum);
    CHECK(totals.samples_done == 64);
    CHECK(totals.most_samples == std::min(wanted, most));
    const bool reached = most > wanted;
    CHECK(totals.quiet_pixels == (reached ? 81 : 40) * 45);
    CHECK((totals.greatest_noise <= target) == reached);
    CHECK(shown == sum);
  }
}

TEST_CASE("the reported noise is the actual noise") {
  const Scene scene = scene_of(480, 160, 128);
  NoisyExecutor executor;
  RenderOptions options = until(0, 160, 480);
  options.channels = film::parse_channels("noise");
  int within = 0, all = 0;
  render_rows(scene, executor, options, [&](const film::Rows& rows) {
    for (int y = 0; y < rows.color.height(); ++y) {
      for (int x = 48; x < 480; ++x) {
        const double off = std::abs(double(rows.color.pixel(x, y)[0]) - 0.5);
        within += off <= double(*rows[film::channel_named("noise")].pixel(x, y)) * (0.5 + 0.01);
        ++all;
      }
    }
  });
  // The share within the 95 % interval, from 69 120 pixels, has a standard error of 0.1 %.
  CHECK(double(within) / all == doctest::Approx(0.95).epsilon(0.005));
}

TEST_CASE("bands have the noise of the whole picture, however few rows are requested") {
  const Scene scene = scene_of(70, 33, 16);
  std::vector<float> whole;
  for (const int rows : {33, 20, 1}) {
    RenderOptions options = until(0, rows, 70);
    options.channels = film::parse_channels("noise");
    NoisyExecutor executor;
    std::vector<float> noise;
    const RenderTotals totals = render_rows(scene, executor, options, [&](const film::Rows& finished) {
      const std::vector<float>& values = finished[film::channel_named("noise")].samples();
      noise.insert(noise.end(), values.begin(), values.end());
    });
    CHECK(totals.bands == (rows == 33 ? 1 : rows == 20 ? 3 : 5));
    if (whole.empty()) whole = noise;
    CHECK(noise == whole);
  }
}

TEST_CASE("dark pixels are measured against the brightness that the picture shows as 1") {
  film::Film sums;
  for (const double exposure : {0.0, 3.0}) {
    sums.reset(8, 8, film::parse_channels("noise"), std::exp2(-exposure));
    std::vector<PixelSample> samples(64);
    CHECK(std::isnan(sums.noise({0, 0, 8, 8})));
    for (const double value : {0.0, 2e-3}) {
      for (PixelSample& sample : samples) sample.color = Vec3(value);
      sums.add({0, 0, 8, 8}, samples);
    }
    CHECK(sums.noise({0, 0, 8, 8}) ==
          doctest::Approx(1.96 * 1e-3 / (1e-3 + 0.01 * std::exp2(-exposure))).epsilon(1e-9));
  }
}

TEST_CASE("adaptive sampling gives the same picture in bands with their own blocks, and resumed anywhere") {
  const TemporaryFolder folder;
  const std::string file = folder / "a";
  const Scene scene = scene_of(70, 33, 2048);
  for (const int rows : {33, 16}) {
    CAPTURE(rows);
    RenderOptions options = until(target, rows, 70);
    NoisyExecutor counting([](int) { return true; });
    const Rendering whole = render::render(scene, counting, options);
    REQUIRE(whole.most_samples == 512);
    for (int stop = 0; stop < counting.calls; stop += counting.calls / 23) {
      CAPTURE(stop);
      {
        Checkpoint checkpoint = Checkpoint::begin(file, {}, 1e6);
        options.checkpoint = &checkpoint;
        NoisyExecutor executor([=](int call) { return call != stop; });
        REQUIRE(render::render(scene, executor, options).interrupted);
      }
      Checkpoint checkpoint = Checkpoint::resume(file, {}, 1e6);
      options.checkpoint = &checkpoint;
      NoisyExecutor executor;
      const Rendering rest = render::render(scene, executor, options);
      CHECK(same_rendering(rest, whole));
      CHECK(rest.samples_taken == whole.samples_taken);
      CHECK(rest.quiet_pixels == whole.quiet_pixels);
      CHECK(rest.greatest_noise == whole.greatest_noise);
      checkpoint.remove();
    }
  }
}

TEST_CASE("the unfinished area is covered once, by few rectangles") {
  film::Film sums;
  sums.reset(100, 50, film::parse_channels("noise"));
  sums.set_finished({16, 8, 32, 16}, true);
  const AdaptiveSampling adaptive(target, 64, false, sums);
  std::vector<int> covered(100 * 50);
  for (const auto& [row, height] : {std::pair{0, 11}, {11, 26}, {37, 13}}) {
    const std::vector<Rect> parts = adaptive.left(row, height);
    CHECK(parts.size() <= 4);
    for (const Rect& part : parts) {
      CHECK(part.y >= row);
      CHECK(part.y + part.height <= row + height);
      for (int i = 0; i < part.pixels(); ++i)
        ++covered[size_t((part.y + i / part.width) * 100 + part.x + i % part.width)];
    }
  }
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 100; ++x)
      REQUIRE(covered[size_t(y * 100 + x)] == !(x >= 16 && x < 48 && y >= 8 && y < 24));
}

TEST_CASE("a finished block goes on if it is found noisy later and may resume") {
  for (const bool resumes : {false, true}) {
    film::Film sums;
    sums.reset(80, 8, film::parse_channels("noise"));
    AdaptiveSampling adaptive(target, 16, resumes, sums);
    std::vector<double> noise(10, 2 * target);
    for (size_t i = 0; i < 5; ++i) noise[i] = target / 2;
    adaptive.judge(sums, noise);
    CHECK(sums.finished(0, 0));
    CHECK(!sums.finished(79, 0));
    std::ranges::fill(noise, target / 2);
    noise[0] = 2 * target;
    adaptive.judge(sums, noise);
    CHECK(sums.finished(0, 0) == !resumes);
    CHECK(sums.finished(79, 0));
    CHECK(adaptive.finished() == !resumes);
  }
}
