// Tests of a film's sums of samples, against sums made here.
#include "host/film/film.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "host/core/halves.hpp"
#include "host/scene/luminance.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::film;

namespace {

constexpr int columns = 9, lines = 7, taken = 5;

struct Samples {
  std::vector<PixelSample> samples;
  std::vector<AuxiliarySample> auxiliaries;
};

// `taken` random samples of each pixel.
std::vector<Samples> random_samples() {
  test::Random random{test::seed() + 3};
  const auto number = [&](double most) { return uint32_t(random.uniform(0, most)); };
  std::vector<Samples> all(taken);
  for (Samples& of_index : all) {
    for (int i = 0; i < columns * lines; ++i) {
      PixelSample sample;
      sample.color = Vec3(random.uniform(0, 2), random.uniform(0, 1), random.uniform(-1, 1));
      sample.reflected = number(5);
      sample.refracted = number(5);
      sample.hits = number(9);
      sample.rays = 1 + sample.reflected + sample.refracted + number(7);
      sample.flags = number(20) == 0 ? stack_overflow : 0u;
      of_index.samples.push_back(sample);
      of_index.auxiliaries.push_back(
          {random.direction(), random.direction(), number(20) == 0 ? media_overflow : 0u});
    }
  }
  return all;
}

Film film_of(const Channels& channels, const std::vector<Samples>& all) {
  Film film;
  film.reset(columns, lines, channels);
  for (const Samples& each : all) film.add({0, 0, columns, lines}, each.samples, each.auxiliaries);
  return film;
}

Channels all_of_samples() {
  Channels all;
  for (const ChannelType& type : channel_types())
    if (type.of_samples()) all.push_back(&type);
  return all;
}

// The mean of value(sample, auxiliary) over the samples of pixel i.
template <typename Value>
float mean(const std::vector<Samples>& all, size_t i, const Value& value) {
  double sum = 0;
  for (const Samples& each : all) sum += value(each.samples[i], each.auxiliaries[i]);
  return float(sum / double(all.size()));
}

}  // namespace

TEST_CASE("channels are the means of a pixel's samples") {
  const std::vector<Samples> all = random_samples();
  const Rows rows = film_of(all_of_samples(), all).rows(0, lines);
  const auto value = [&](std::string_view name, size_t i, size_t component = 0) {
    const image::Image& image = rows[channel_named(name)];
    return image.samples()[i * size_t(image.channels()) + component];
  };
  uint32_t flags = 0;
  for (size_t i = 0; i < size_t(columns * lines); ++i) {
    const auto mean_of = [&](const auto& of) { return mean(all, i, of); };
    using S = const PixelSample&;
    using A = const AuxiliarySample&;
    const float reflected = mean_of([](S s, A) { return s.reflected; });
    const float refracted = mean_of([](S s, A) { return s.refracted; });
    CHECK(value("hits", i) == mean_of([](S s, A) { return s.hits; }));
    CHECK(value("rays", i) == mean_of([](S s, A) { return s.rays; }));
    CHECK(value("bounces", i) == reflected + refracted);
    CHECK(value("ray_kinds", i, 0) == reflected);
    CHECK(value("ray_kinds", i, 1) == refracted);
    CHECK(value("ray_kinds", i, 2) == mean_of([](S s, A) { return s.rays - 1 - s.reflected - s.refracted; }));
    CHECK(value("samples", i) == taken);
    for (int c = 0; c < 3; ++c) {
      CHECK(rows.color.samples()[3 * i + size_t(c)] == mean_of([&](S s, A) { return s.color[c]; }));
      CHECK(value("noisy", i, size_t(c)) == rows.color.samples()[3 * i + size_t(c)]);
      double half = 0, half_albedo = 0, half_normal = 0, squares = 0, sum = 0;
      for (size_t s = 0; s < all.size(); ++s) {
        const double color = all[s].samples[i].color[c];
        sum += color;
        squares += color * color;
        if (!in_first_half(s)) continue;
        half += color;
        half_albedo += all[s].auxiliaries[i].albedo[c];
        half_normal += all[s].auxiliaries[i].normal[c];
      }
      const double n = double(all.size()), in_half = double(first_half_of(all.size()));
      CHECK(value("half", i, size_t(c)) == float(half / in_half));
      CHECK(value("half_albedo", i, size_t(c)) == float(half_albedo / in_half));
      CHECK(value("half_normal", i, size_t(c)) == float(half_normal / in_half));
      CHECK(double(value("variance", i, size_t(c))) ==
            doctest::Approx((squares - sum * sum / n) / (n * (n - 1))).epsilon(1e-5));
      CHECK(value("albedo", i, size_t(c)) == mean_of([&](S, A a) { return a.albedo[c]; }));
      CHECK(value("shading_normal", i, size_t(c)) == mean_of([&](S, A a) { return a.normal[c]; }));
    }
    float brightest = 0;
    uint32_t its_flags = 0;
    for (const Samples& each : all) {
      brightest = std::max(brightest, float(luminance(each.samples[i].color)));
      its_flags |= each.samples[i].flags | each.auxiliaries[i].flags;
    }
    CHECK(value("brightest", i) == brightest);
    CHECK(value("flags", i) == float(its_flags));
    flags |= its_flags;
  }
  CHECK(rows.flags == flags);
}

TEST_CASE("a channel's values do not depend on other channels, nor on storing its sums") {
  const std::vector<Samples> all = random_samples();
  const Channels channels = all_of_samples();
  const Film film = film_of(channels, all);
  const Rows together = film.rows(0, lines);
  const auto same = [](const image::Image& a, const image::Image& b) {
    return a.same_size(b) && std::ranges::equal(a.samples(), b.samples(), {}, std::bit_cast<uint32_t, float>,
                                                std::bit_cast<uint32_t, float>);
  };
  for (const Channel each : channels) {
    CAPTURE(each->name);
    CHECK(same(film_of({each}, all).rows(0, lines)[each], together[each]));
  }

  Film restored;
  restored.reset(columns, lines, channels);
  const auto from = film.parts();
  const auto to = restored.parts();
  REQUIRE(from.size() == to.size());
  for (size_t i = 0; i < from.size(); ++i) {
    REQUIRE(from[i].size() == to[i].size());
    if (!from[i].empty()) std::memcpy(to[i].data(), from[i].data(), from[i].size());
  }
  const Rows again = restored.rows(2, 3), before = film.rows(2, 3);
  CHECK(same(again.color, before.color));
  for (const Channel each : channels) CHECK(same(again[each], before[each]));
}
