#include "host/importers/cloud_builder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/core/diagnostic.hpp"
#include "host/core/free_memory.hpp"
#include "host/core/parallel_for.hpp"
#include "host/importers/malformed.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::importers {

namespace {

// The neighbours of a point that count: as many as a point of a square grid has at the grid's width.
constexpr size_t neighbours = 4;
// The radius, in distances to the fourth neighbour: on a square grid, and where the nearest neighbour is as
// near as nothing. For points at random, whose nearest neighbour is at 0.45 of that distance, it is 1.2.
constexpr double radius_on_grid = 0.75, radius_of_pairs = 1.55;

// Limits on the points whose neighbours are found, and on the distances that are computed together.
constexpr size_t least_samples = 16, most_samples = 256;
constexpr size_t most_distances = 600'000'000;

// Samples that one thread measures together, over so many points at a time that they stay in its cache.
constexpr size_t samples_together = 16, points_together = 4096;

struct Neighbour {
  double squared = std::numeric_limits<double>::infinity();  // squared distance
  Vec3 position{0.0};
};
// The nearest neighbours so far, in rising order.
using Nearest = std::array<Neighbour, neighbours>;

void note_neighbour(Nearest& nearest, double squared, const Vec3& position) {
  for (const Neighbour& known : nearest)
    if (known.squared == squared && known.position == position) return;
  size_t at = neighbours - 1;
  for (; at > 0 && nearest[at - 1].squared > squared; --at) nearest[at] = nearest[at - 1];
  nearest[at] = {squared, position};
}

// The nearest neighbours of some of the points.
std::vector<Nearest> find_neighbours(std::span<const Vec3> positions) {
  const size_t count = positions.size();
  const size_t samples = std::min(count, std::clamp(most_distances / count, least_samples, most_samples));
  std::vector<Nearest> nearest(samples);
  const size_t groups = (samples + samples_together - 1) / samples_together;
  parallel_for(0, static_cast<int>(groups), [&](int group) {
    const size_t first = static_cast<size_t>(group) * samples_together;
    const size_t last = std::min(samples, first + samples_together);
    for (size_t begin = 0; begin < count; begin += points_together) {
      const auto points = positions.subspan(begin, std::min(points_together, count - begin));
      for (size_t i = first; i < last; ++i) {
        const Vec3 from = positions[(2 * i + 1) * count / (2 * samples)];
        for (const Vec3& p : points) {
          const Vec3 way = p - from;
          const double squared = glm::dot(way, way);
          if (squared < nearest[i].back().squared && squared > 0) note_neighbour(nearest[i], squared, p);
        }
      }
    }
  });
  return nearest;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

bool in_range(const Vec3& p) {
  return std::fabs(p.x) <= max_coordinate && std::fabs(p.y) <= max_coordinate &&
         std::fabs(p.z) <= max_coordinate;
}

// Points whose normal has no direction become spheres, with a warning that counts them.
void set_normals(std::span<const Vec3> normals, PointCloud& cloud, std::vector<std::string>& warnings) {
  cloud.normals.reserve(normals.size());
  size_t without = 0;
  for (const Vec3& n : normals) {
    const double length = glm::length(n);
    const bool known = length > 0 && std::isfinite(length);
    cloud.normals.emplace_back(known ? n / length : Vec3(0.0));
    without += !known;
  }
  if (without > 0)
    warnings.push_back(fmt::format("{} of its points have no normal, and are shown as spheres", without));
}

}  // namespace

double closing_radius(std::span<const Vec3> positions) {
  std::vector<double> distances, ratios;
  for (const Nearest& nearest : find_neighbours(positions)) {
    size_t known = neighbours;  // fewer in a cloud of few points
    while (known > 0 && !std::isfinite(nearest[known - 1].squared)) --known;
    if (known == 0) continue;
    distances.push_back(std::sqrt(nearest[known - 1].squared));
    ratios.push_back(std::sqrt(nearest[0].squared) / distances.back());
  }
  if (!distances.empty()) {
    const double factor = radius_of_pairs + (radius_on_grid - radius_of_pairs) * median(ratios);
    const double radius = factor * median(distances);
    if (radius >= min_radius) return radius;
  }
  // All points are at one position: any radius will do.
  const double away = magnitude(positions.front());
  return away >= 1e-9 ? away / 100 : 1;
}

std::shared_ptr<PointCloud> build_cloud(RawPoints raw, const ImportOptions& options,
                                        std::vector<std::string>& warnings) {
  if (options.point_shape != PointShape::disk)
    free_memory(raw.normals);
  else if (raw.normals.empty() && !raw.positions.empty())
    throw malformed(raw.name, "its points have no normals, which disks need: show them as spheres");
  auto cloud = std::make_shared<PointCloud>();
  cloud->name = std::move(raw.name);
  const size_t count = raw.positions.size();
  size_t kept = 0;
  for (size_t i = 0; i < count; ++i) {
    if (!in_range(raw.positions[i])) continue;
    raw.positions[kept] = raw.positions[i];
    if (!raw.colors.empty()) raw.colors[kept] = raw.colors[i];
    if (!raw.normals.empty()) raw.normals[kept] = raw.normals[i];
    ++kept;
  }
  if (kept < count)
    warnings.push_back(
        fmt::format("{} of its {} points were left out: their coordinates are not finite or beyond 1e12",
                    count - kept, count));
  if (kept == 0) return nullptr;
  raw.positions.resize(kept);
  cloud->positions = std::move(raw.positions);
  if (!raw.colors.empty()) {
    cloud->colors.assign(raw.colors.begin(), raw.colors.begin() + std::ptrdiff_t(kept));
    free_memory(raw.colors);
  }
  if (!raw.normals.empty()) {
    raw.normals.resize(kept);
    set_normals(raw.normals, *cloud, warnings);
    free_memory(raw.normals);
  }
  cloud->radius = options.point_size ? *options.point_size / 2 : closing_radius(cloud->positions);
  return cloud;
}

void report_left_out(std::string_view fields, std::vector<std::string> names,
                     std::vector<std::string>& warnings) {
  constexpr size_t most_named = 8;
  const size_t count = names.size();
  if (count == 0) return;
  names.resize(std::min(count, most_named));
  warnings.push_back(
      printable(fmt::format("{} of its {} {} left out: {}{}", count, fields, count == 1 ? "was" : "were",
                            fmt::join(names, ", "), count > most_named ? ", …" : "")));
}

}  // namespace eyeray::engine::importers
