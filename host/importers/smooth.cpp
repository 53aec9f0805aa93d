#include "host/importers/smooth.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "host/core/parallel_for.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/triangle.hpp"

namespace eyeray::engine::importers {

namespace {

constexpr uint32_t no_vertex = 0xffffffff;

uint64_t hash(const Vec3& p) {
  uint64_t sum = 0;
  for (int i = 0; i < 3; ++i) {
    sum = (sum ^ std::bit_cast<uint64_t>(p[i] + 0.0)) * 0x9e3779b97f4a7c15u;  // −0 becomes 0
    sum ^= sum >> 32;
  }
  return sum;
}

// The number of each vertex's point, and the count of points. Vertices at the same position share a point.
std::pair<std::vector<uint32_t>, uint32_t> weld(const std::vector<Vec3>& positions) {
  std::vector<uint32_t> points(positions.size());
  std::vector<uint32_t> table(std::bit_ceil(2 * positions.size() + 1),
                              no_vertex);  // first vertices of points
  uint32_t count = 0;
  for (uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
    size_t slot = hash(positions[vertex]) & (table.size() - 1);
    while (table[slot] != no_vertex && positions[table[slot]] != positions[vertex])
      slot = (slot + 1) & (table.size() - 1);
    if (table[slot] == no_vertex) {
      table[slot] = vertex;
      points[vertex] = count++;
    } else {
      points[vertex] = points[table[slot]];
    }
  }
  return {std::move(points), count};
}

class Smoother {
 public:
  Smoother(const Mesh& mesh, std::span<const Vec3> faces, double degrees)
      : mesh_(mesh), faces_(faces), least_cosine_(std::cos(glm::radians(degrees))) {
    std::tie(points_, count_) = weld(mesh.positions);
    sort_corners();
    measure_angles();
    group_.resize(corners_.size());
    firsts_.resize(count_ + 1, 0);
    over_points([&](uint32_t point) { firsts_[point + 1] = join(point); });
    for (uint32_t point = 0; point < count_; ++point) firsts_[point + 1] += firsts_[point];
    sums_.resize(firsts_[count_], Vec3(0));
    over_points([&](uint32_t point) { sum(point); });
  }

  // The surface that a corner (face · 3 + i) belongs to, numbered over all points, and a surface's normal.
  uint32_t surface(uint32_t corner) const { return firsts_[points_[vertex(corner)]] + group_[corner]; }
  const Vec3& normal(uint32_t surface) const { return sums_[surface]; }
  uint32_t surfaces() const { return firsts_[count_]; }

 private:
  uint32_t vertex(uint32_t corner) const { return mesh_.triangles[corner / 3][corner % 3]; }
  template <typename Body>
  void over_points(const Body& body) {
    parallel_for(0, static_cast<int>(count_), [&](int point) { body(static_cast<uint32_t>(point)); });
  }
  std::span<const uint32_t> around(uint32_t point) const {
    return {corners_.data() + starts_[point], starts_[point + 1] - starts_[point]};
  }

  void sort_corners();
  void measure_angles();
  uint32_t join(uint32_t point);
  void sum(uint32_t point);

  const Mesh& mesh_;
  std::span<const Vec3> faces_;
  double least_cosine_;
  std::vector<uint32_t> points_;  // the point of each vertex
  uint32_t count_ = 0;            // number of points
  std::vector<uint32_t> starts_;  // the index of each point's first corner in …
  std::vector<uint32_t> corners_;
  std::vector<float> angles_;     // the angle at each corner
  std::vector<uint32_t> group_;   // the surface of each corner, numbered at its point
  std::vector<uint32_t> firsts_;  // the first surface of each point
  std::vector<Vec3> sums_;        // the normal of each surface
};

void Smoother::sort_corners() {
  starts_.assign(count_ + 2, 0);
  const auto corners = static_cast<uint32_t>(3 * mesh_.triangles.size());
  for (uint32_t corner = 0; corner < corners; ++corner) ++starts_[points_[vertex(corner)] + 2];
  for (uint32_t point = 0; point < count_; ++point) starts_[point + 2] += starts_[point + 1];
  corners_.resize(corners);
  for (uint32_t corner = 0; corner < corners; ++corner)
    corners_[starts_[points_[vertex(corner)] + 1]++] = corner;
}

void Smoother::measure_angles() {
  angles_.resize(3 * mesh_.triangles.size());
  parallel_for(0, static_cast<int>(mesh_.triangles.size()), [&](int i) {
    const auto face = static_cast<size_t>(i);
    std::array<Vec3, 3> edges;  // from each corner to the next
    for (size_t k = 0; k < 3; ++k) {
      edges[k] = unit(mesh_.positions[mesh_.triangles[face][(k + 1) % 3]] -
                      mesh_.positions[mesh_.triangles[face][k]]);
    }
    for (size_t k = 0; k < 3; ++k) {
      const auto cosine = static_cast<float>(glm::dot(edges[k], -edges[(k + 2) % 3]));
      angles_[3 * face + k] = std::acos(std::clamp(cosine, -1.0f, 1.0f));
    }
  });
}

// Numbers the surfaces around a point, and returns their count.
uint32_t Smoother::join(uint32_t point) {
  const std::span<const uint32_t> corners = around(point);
  const auto count = static_cast<uint32_t>(corners.size());

  // Every corner has two edges at the point; those with the same other end are neighbours.
  struct Edge {
    uint32_t end;
    uint32_t corner;  // index in `corners`
  };
  thread_local std::vector<Edge> edges;
  thread_local std::vector<uint32_t> parents;
  edges.clear();
  parents.resize(count);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t face = corners[i] / 3;
    for (const uint32_t step : {1u, 2u}) {
      const uint32_t other = mesh_.triangles[face][(corners[i] % 3 + step) % 3];
      edges.push_back({points_[other], i});
    }
    parents[i] = i;
  }
  std::ranges::sort(edges, {}, [](const Edge& edge) { return std::pair(edge.end, edge.corner); });

  // Join neighbours that are at a small angle to each other.
  const auto root = [&](uint32_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
  };
  for (size_t k = 0; k + 1 < edges.size(); ++k) {
    if (edges[k].end != edges[k + 1].end) continue;
    const Vec3& a = faces_[corners[edges[k].corner] / 3];
    const Vec3& b = faces_[corners[edges[k + 1].corner] / 3];
    if (!(glm::dot(a, b) > least_cosine_)) continue;
    const uint32_t one = root(edges[k].corner);
    const uint32_t two = root(edges[k + 1].corner);
    parents[std::max(one, two)] = std::min(one, two);
  }

  // Number the surfaces by their roots. A root comes before the corners that are joined to it.
  uint32_t surfaces = 0;
  for (uint32_t i = 0; i < count; ++i)
    group_[corners[i]] = parents[i] == i ? surfaces++ : group_[corners[root(i)]];
  return surfaces;
}

void Smoother::sum(uint32_t point) {
  for (const uint32_t corner : around(point))
    sums_[firsts_[point] + group_[corner]] += double(angles_[corner]) * faces_[corner / 3];
  for (uint32_t surface = firsts_[point]; surface < firsts_[point + 1]; ++surface) {
    if (magnitude(sums_[surface]) > 0) sums_[surface] = unit(sums_[surface]);
  }
}

}  // namespace

void add_smooth_normals(Mesh& mesh, std::span<const Vec3> faces, double degrees) {
  const Smoother smoother(mesh, faces, degrees);

  // Split each vertex into one for each surface that it is on. (Where surfaces and seams of uv cross, a
  // vertex may be made more than once.) The smoother reads a corner of the mesh before that corner changes.
  std::vector<uint32_t> made(smoother.surfaces(), no_vertex);  // the last vertex made for a surface …
  std::vector<uint32_t> from;                                  // … and the vertex from which each was made
  from.reserve(mesh.positions.size());
  std::vector<Vec3> normals;
  normals.reserve(mesh.positions.size());
  for (uint32_t face = 0; face < mesh.triangles.size(); ++face) {
    for (uint32_t i = 0; i < 3; ++i) {
      uint32_t& vertex = mesh.triangles[face][i];
      const uint32_t surface = smoother.surface(3 * face + i);
      const bool right = glm::dot(smoother.normal(surface), faces[face]) > least_normal_cosine;
      if (right && made[surface] != no_vertex && from[made[surface]] == vertex) {
        vertex = made[surface];
        continue;
      }
      const auto fresh = static_cast<uint32_t>(from.size());
      from.push_back(vertex);
      normals.push_back(right ? smoother.normal(surface) : faces[face]);
      if (right) made[surface] = fresh;
      vertex = fresh;
    }
  }

  const auto take = [&](const auto& old) {
    std::decay_t<decltype(old)> all;
    all.reserve(from.size());
    for (const uint32_t vertex : from) all.push_back(old[vertex]);
    return all;
  };
  mesh.positions = take(mesh.positions);
  if (!mesh.uv.empty()) mesh.uv = take(mesh.uv);
  if (!mesh.second_uv.empty()) mesh.second_uv = take(mesh.second_uv);
  if (!mesh.colors.empty()) mesh.colors = take(mesh.colors);
  if (!mesh.alphas.empty()) mesh.alphas = take(mesh.alphas);
  mesh.normals = std::move(normals);
}

}  // namespace eyeray::engine::importers
