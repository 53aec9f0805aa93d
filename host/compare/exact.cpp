#include "host/compare/exact.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "host/core/error.hpp"

namespace eyeray::engine::compare {

namespace {

constexpr int64_t max_bound = 64;

bool same_bits(double a, double b) {
  return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
}
bool same_bits(const Vec2& a, const Vec2& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y);
}
bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

std::span<const TracedSample> samples_at(const Frame& frame, size_t pixel) {
  const size_t each = frame.samples.size() / size_t(frame.area.pixels());
  return std::span(frame.samples).subspan(pixel * each, each);
}

bool same_sample(const TracedSample& a, const TracedSample& b) {
  return same_bits(Vec3(a.color), Vec3(b.color)) && a.trail == b.trail && a.hits == b.hits &&
         a.rays == b.rays;
}
bool same_trails(std::span<const TracedSample> a, std::span<const TracedSample> b) {
  return std::ranges::equal(a, b, {}, &TracedSample::trail, &TracedSample::trail);
}

bool same_ids(const FirstHit& a, const FirstHit& b) {
  return a.primitive == b.primitive && a.material == b.material;
}
bool same_bits(const FirstHit& a, const FirstHit& b) {
  return same_ids(a, b) && same_bits(a.t, b.t) && same_bits(a.position, b.position) &&
         same_bits(a.normal, b.normal) && same_bits(a.normal_geometric, b.normal_geometric) &&
         same_bits(a.cosine, b.cosine) && same_bits(a.uv, b.uv);
}

Seam first_seam(const FirstHit& a, const FirstHit& b, bool trails_differ, bool colors_differ) {
  if (a.primitive != b.primitive) return Seam::primitive;
  if (!same_bits(a.t, b.t)) return Seam::t;
  if (!same_bits(a.position, b.position)) return Seam::position;
  if (!same_bits(a.normal, b.normal)) return Seam::normal;
  if (!same_bits(a.normal_geometric, b.normal_geometric) || !same_bits(a.cosine, b.cosine))
    return Seam::geometric_normal;
  if (!same_bits(a.uv, b.uv)) return Seam::uv;
  if (a.material != b.material) return Seam::material;
  if (trails_differ) return Seam::trail;
  return colors_differ ? Seam::color : Seam::counts;
}

std::array<double, 13> values(const FirstHit& hit) {
  const Vec3 &p = hit.position, &n = hit.normal, &g = hit.normal_geometric;
  return {hit.t, p.x, p.y, p.z, n.x, n.y, n.z, g.x, g.y, g.z, hit.cosine, hit.uv.x, hit.uv.y};
}

}  // namespace

int64_t ulp_distance(float a, float b) {
  if (std::isnan(a) || std::isnan(b)) {
    return std::isnan(a) && std::isnan(b) ? 0 : std::numeric_limits<int64_t>::max();
  }
  // Maps sign and magnitude to integers in the floats' order, in which −0 and +0 coincide.
  const auto order = [](float x) {
    const uint32_t bits = std::bit_cast<uint32_t>(x);
    const int64_t magnitude = bits & 0x7fffffffu;
    return bits >> 31 ? -magnitude : magnitude;
  };
  return std::abs(order(a) - order(b));
}

bool ExactComparison::passes(int64_t ulp) const {
  CHECK_LE(0, ulp);
  CHECK_LE(ulp, max_bound);
  if (!incomparable.empty() || pixels <= 0 || different_ids > 0 || rays != other_rays) return false;
  return ulp == 0 ? different_pixels == 0 : max_ulp <= ulp;
}

ExactComparison compare_exactly(const Frame& value, const Frame& other) {
  ExactComparison result;
  result.rays = value.rays;
  result.other_rays = other.rays;
  result.incomparable = why_incomparable(value, other);
  if (!result.incomparable.empty()) return result;

  for (int y = 0; y < value.area.height; ++y) {
    for (int x = 0; x < value.area.width; ++x) {
      ++result.pixels;
      const FirstHit &hit = value.first_hit(x, y), &other_hit = other.first_hit(x, y);
      const Vec3 color = color_at(value.color, x, y), other_color = color_at(other.color, x, y);
      const Counts counts = counts_at(value, x, y), other_counts = counts_at(other, x, y);

      // Count the differing values.
      const size_t pixel = size_t(y) * size_t(value.area.width) + size_t(x);
      const auto samples = samples_at(value, pixel), other_samples = samples_at(other, pixel);
      const bool samples_differ = !std::ranges::equal(samples, other_samples, same_sample);
      const bool trails_differ = samples_differ && !same_trails(samples, other_samples);
      const bool colors_differ = !same_bits(color, other_color) || (samples_differ && !trails_differ);
      const bool first_hits_differ = !same_bits(hit, other_hit);
      if (!colors_differ && !samples_differ && !first_hits_differ && same_bits(counts, other_counts))
        continue;
      ++result.different_pixels;
      result.different_colors += colors_differ;
      result.different_first_hits += first_hits_differ;
      result.different_ids += !same_ids(hit, other_hit) || trails_differ;

      // Measure the largest distance of any two values.
      int64_t ulp = 0;
      for (int c = 0; c < 2; ++c) ulp = std::max(ulp, ulp_distance(float(counts[c]), float(other_counts[c])));
      for (int c = 0; c < 3; ++c) ulp = std::max(ulp, ulp_distance(float(color[c]), float(other_color[c])));
      for (size_t i = 0; i < samples.size(); ++i)
        for (int c = 0; c < 3; ++c)
          ulp = std::max(ulp, ulp_distance(samples[i].color[c], other_samples[i].color[c]));
      const auto a = values(hit), b = values(other_hit);
      for (size_t i = 0; i < a.size(); ++i) ulp = std::max(ulp, ulp_distance(float(a[i]), float(b[i])));
      if (result.worst.seam == Seam::none || ulp > result.max_ulp) {
        result.worst = {{value.area.x + x, value.area.y + y},
                        color,
                        other_color,
                        counts,
                        other_counts,
                        hit,
                        other_hit,
                        double(ulp),
                        first_seam(hit, other_hit, trails_differ, colors_differ)};
      }
      result.max_ulp = std::max(result.max_ulp, ulp);
    }
  }
  return result;
}

}  // namespace eyeray::engine::compare
