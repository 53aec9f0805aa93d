// Checks outlines: those that a scene's author writes, by the reader of planar_region.hpp, and those of
// fonts.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/shapes/planar_region.hpp"
#include "host/shapes/plane_axes.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

// Outlines closer to each other than this share of the region's size touch.
constexpr double touching = 1e-9;

double cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}

double distance(const Vec2& p, const Vec2& from, const Vec2& to) {
  const Vec2 along = to - from;
  const double share = std::clamp(glm::dot(p - from, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::length(p - (from + along * share));
}

class RegionCheck {
 public:
  explicit RegionCheck(const PlanarRegion& region) {
    outlines_.push_back(&region.outer);
    for (const Outline& hole : region.holes) outlines_.push_back(&hole);
  }

  // Each step relies on those before it.
  std::optional<RegionFault> run(bool nested) {
    const bool passes =
        has_vertices() && is_distinct() && has_area() && is_flat() && is_simple() && (!nested || is_nested());
    return passes ? std::nullopt : std::optional(fault_);
  }

 private:
  // A vertex, counted from 0 here and from 1 in messages; outline 0 is the outer one.
  struct Corner {
    size_t outline;
    size_t vertex;
  };
  struct Edge {
    Corner start;
    Vec2 from;
    Vec2 to;
  };

  // Notes a fault at an outline, or at a vertex. Always returns false.
  bool fail(size_t outline, std::string message) {
    fault_ = {outline, std::nullopt, outline, std::move(message)};
    return false;
  }
  bool fail(const Corner& at, std::string message) {
    fault_ = {at.outline, at.vertex, at.outline, std::move(message)};
    return false;
  }

  std::string name(size_t outline) const {
    return outline == 0 ? "the outline" : fmt::format("hole {}", outline);
  }
  size_t count(size_t outline) const { return outlines_[outline]->size(); }

  bool has_vertices() {
    size_t all = 0;
    for (size_t k = 0; k < outlines_.size(); ++k) {
      if (count(k) < 3) return fail(k, fmt::format("an outline needs at least 3 vertices, not {}", count(k)));
      all += count(k);
    }
    if (all > most_outline_vertices)
      return fail(0, fmt::format("{} vertices are too many, at most {} are possible: cut the outline into "
                                 "several, which close tightly where they share vertices",
                                 all, most_outline_vertices));
    return true;
  }

  bool is_distinct() {
    for (size_t k = 0; k < outlines_.size(); ++k) {
      const Outline& outline = *outlines_[k];
      std::vector<size_t> order(outline.size());
      std::iota(order.begin(), order.end(), size_t{0});
      std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        const Vec3 &p = outline[a], &q = outline[b];
        return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
      });
      for (size_t i = 1; i < order.size(); ++i) {
        const size_t before = order[i - 1], again = order[i];
        if (outline[before] != outline[again]) continue;
        const bool closes = before == 0 && again + 1 == outline.size() && again > 2;
        return fail({k, again},
                    closes ? "the last vertex is the first one again: leave it out, outlines are closed"
                           : fmt::format("vertex {} is at the same point as vertex {}: an outline passes a "
                                         "point only once; holes are written as `holes`",
                                         again + 1, before + 1));
      }
    }
    return true;
  }

  bool has_area() {
    // Take the widest triangle with the first vertex: an outline that crosses itself has a wide one, even if
    // its area sums to 0.
    for (size_t k = 0; k < outlines_.size(); ++k) {
      const Outline& outline = *outlines_[k];
      const auto farthest = [&](const auto& measure) {
        return *std::max_element(outline.begin(), outline.end(),
                                 [&](const Vec3& a, const Vec3& b) { return measure(a) < measure(b); });
      };
      const Vec3 first = outline[0];
      const Vec3 far = farthest([&](const Vec3& p) { return magnitude(p - first); }) - first;
      const double size = magnitude(far);
      const auto normal = [&](const Vec3& p) { return glm::cross(far / size, (p - first) / size); };
      const Vec3 widest = normal(farthest([&](const Vec3& p) { return magnitude(normal(p)); }));
      if (magnitude(widest) < touching)
        return fail(k, name(k) + " has no area: its vertices lie on one line");
      if (k > 0) continue;
      size_ = size;
      normal_ = PlanarRegion{outline}.normal();
      if (normal_ == Vec3(0)) normal_ = unit(widest);
    }
    return true;
  }

  bool is_flat() {
    Corner worst{};
    double most = 0;
    const Vec3 first = outlines_[0]->front();
    for (size_t k = 0; k < outlines_.size(); ++k)
      for (size_t i = 0; i < count(k); ++i) {
        const double off = std::fabs(glm::dot(normal_, (*outlines_[k])[i] - first));
        if (off > most) most = off, worst = {k, i};
      }
    if (most > most_unevenness * size_)
      return fail(worst, fmt::format("vertex {} of {} lies {:.3g} off the plane of the outline, which is "
                                     "{:.3g} long: move it, or use triangles",
                                     worst.vertex + 1, name(worst.outline), most, size_));

    // Lay the region flat for the next steps.
    const auto [u, v] = plane_axes(normal_);
    for (const Outline* outline : outlines_) {
      flat_.emplace_back();
      for (const Vec3& p : *outline)
        flat_.back().emplace_back(glm::dot(u, p - first), glm::dot(v, p - first));
    }
    return true;
  }

  bool is_simple() {
    std::vector<Edge> edges;
    for (size_t k = 0; k < flat_.size(); ++k)
      for (size_t i = 0; i < flat_[k].size(); ++i)
        edges.push_back({{k, i}, flat_[k][i], flat_[k][(i + 1) % flat_[k].size()]});

    // Edges that do not overlap in x cannot cross.
    const auto low = [](const Edge& edge) { return std::min(edge.from.x, edge.to.x); };
    const auto high = [](const Edge& edge) { return std::max(edge.from.x, edge.to.x); };
    std::stable_sort(edges.begin(), edges.end(),
                     [&](const Edge& a, const Edge& b) { return low(a) < low(b); });
    const double room = touching * size_;
    for (size_t i = 0; i < edges.size(); ++i)
      for (size_t k = i + 1; k < edges.size() && low(edges[k]) <= high(edges[i]) + room; ++k)
        if (!check_pair(edges[i], edges[k], room)) return false;
    return true;
  }

  bool check_pair(const Edge& a, const Edge& b, double room) {
    if (std::min(a.from.y, a.to.y) > std::max(b.from.y, b.to.y) + room ||
        std::min(b.from.y, b.to.y) > std::max(a.from.y, a.to.y) + room)
      return true;
    const size_t k = a.start.outline;
    if (k == b.start.outline) {
      const auto follows = [&](const Edge& before, const Edge& after) {
        return (before.start.vertex + 1) % count(k) == after.start.vertex;
      };
      if (follows(a, b)) return check_turn(a, b, room);
      if (follows(b, a)) return check_turn(b, a, room);
    }
    const bool apart = cross(a.to - a.from, b.from - a.from) * cross(a.to - a.from, b.to - a.from) > 0 ||
                       cross(b.to - b.from, a.from - b.from) * cross(b.to - b.from, a.to - b.from) > 0;
    const double nearest = std::min({distance(a.from, b.from, b.to), distance(a.to, b.from, b.to),
                                     distance(b.from, a.from, a.to), distance(b.to, a.from, a.to)});
    if (apart && nearest > room) return true;
    const bool swap = std::pair(a.start.outline, a.start.vertex) > std::pair(b.start.outline, b.start.vertex);
    const Edge &first = swap ? b : a, &second = swap ? a : b;
    const size_t other = first.start.outline;
    fail(second.start,
         fmt::format("{} crosses or touches {}: its edge from vertex {} crosses that from vertex {}",
                     name(second.start.outline), other == second.start.outline ? "itself" : name(other),
                     second.start.vertex + 1, first.start.vertex + 1));
    fault_.other = other;
    return false;
  }

  // Two consecutive edges may touch only at the vertex between them.
  bool check_turn(const Edge& before, const Edge& after, double room) {
    if (distance(after.to, before.from, before.to) > room &&
        distance(before.from, after.from, after.to) > room)
      return true;
    return fail(after.start, fmt::format("{} turns back on itself at vertex {}", name(after.start.outline),
                                         after.start.vertex + 1));
  }

  // An outline that neither crosses nor touches another lies within it with all of its vertices or with none.
  bool is_nested() {
    for (size_t k = 1; k < flat_.size(); ++k) {
      if (winding(flat_[0], flat_[k][0]) == 0)
        return fail(k, fmt::format("hole {} lies outside the outline", k));
      for (size_t other = 1; other < flat_.size(); ++other)
        if (other != k && winding(flat_[other], flat_[k][0]) != 0)
          return fail(k, fmt::format("hole {} lies within hole {}", k, other));
    }
    return true;
  }

  RegionFault fault_;
  std::vector<const Outline*> outlines_;
  double size_ = 0;
  Vec3 normal_{0};
  std::vector<std::vector<Vec2>> flat_;  // the outlines in the plane
};

}  // namespace

std::optional<RegionFault> find_fault(const PlanarRegion& region, bool nested) {
  return RegionCheck(region).run(nested);
}

std::optional<PlanarRegion> read_region(TableReader& table) {
  PlanarRegion region{table.vec3_list("vertices"), table.outlines("holes")};
  if (!table.valid("vertices") || !table.valid("holes")) return std::nullopt;
  const auto fault = find_fault(region, true);
  if (!fault) return region;
  const auto& [outline, vertex, other, message] = *fault;
  if (outline == 0 && vertex)
    table.error("vertices", message, {*vertex});
  else if (outline == 0)
    table.error("vertices", message);
  else if (vertex)
    table.error("holes", message, {outline - 1, *vertex});
  else
    table.error("holes", message, {outline - 1});
  return std::nullopt;
}

}  // namespace eyeray::engine::shapes
