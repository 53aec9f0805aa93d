#include "host/reference/objects.hpp"

#include <algorithm>
#include <cmath>

#include "host/reference/crossings.hpp"
#include "host/reference/rng.hpp"

namespace eyeray::engine::reference {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool finite(const Bounds& bounds) {
  return magnitude(bounds.min) < infinity && magnitude(bounds.max) < infinity;
}

}  // namespace

Objects::Objects(std::span<const std::unique_ptr<Shape>> shapes, std::span<const Instance> instances,
                 const std::deque<MeshGeometry>& meshes, std::span<const std::unique_ptr<Material>> materials,
                 std::vector<uint64_t> first_ids, Acceleration acceleration)
    : shapes_(shapes), materials_(materials), first_ids_(std::move(first_ids)) {
  for (const Instance& instance : instances)
    instances_.emplace_back(instance, meshes[size_t(instance.mesh)],
                            materials[size_t(instance.material)].get());

  const auto add = [&](size_t object, const Bounds& box) {
    bounded_.push_back(uint32_t(object));
    boxes_.push_back(box);
    bounds_.include(box.min);
    bounds_.include(box.max);
    reach_ = std::max({reach_, magnitude(box.min), magnitude(box.max)});
  };
  for (size_t i = 0; i < shapes.size(); ++i) {
    const Bounds box = shapes[i]->bounds();
    if (finite(box)) {
      add(i, box);
    } else {
      unbounded_.push_back(uint32_t(i));
    }
  }
  for (size_t i = 0; i < instances_.size(); ++i) {
    if (instances_[i].triangles() == 0) continue;
    add(shapes.size() + i, instances_[i].bounds());
    reach_ = std::max(reach_, instances_[i].reach());
    growth_ = std::max(growth_, instances_[i].growth());
  }
  bvh_ = BoxBvh(uint32_t(boxes_.size()), [this](uint32_t i) { return boxes_[i]; }, acceleration);
}

int Objects::material(const Hit& hit) const {
  return is_shape(hit.object) ? shapes_[hit.object]->part(hit.at).material
                              : instances_[hit.object - shapes_.size()].material();
}

int Objects::most_crossings(size_t object) const {
  return is_shape(object) ? shapes_[object]->most_crossings() : reference::most_crossings;
}

// The hit of a shape; none at a cutout. A shape that may have cutouts has no further surface behind one.
std::optional<Intersection> Objects::intersect_shape(size_t index, const Ray& ray,
                                                     const PrimitiveIds::First& before) const {
  const Shape& shape = *shapes_[index];
  const auto hit = shape.intersect(ray);
  const auto& mask = materials_[size_t(shape.material)]->mask;
  if (hit && mask &&
      !mask->covers(shape.surface(ray, *hit).uv, 1, least_alpha(ray.alpha_key, first_id(index, before))))
    return std::nullopt;
  return hit;
}

std::optional<Objects::Hit> Objects::intersect(size_t object, const Ray& ray, double limit,
                                               const PrimitiveIds::First& before) const {
  if (is_shape(object)) {
    const auto hit = intersect_shape(object, ray, before);
    if (!hit) return std::nullopt;
    return Hit{TriangleHit{*hit}, object};
  }
  const auto hit = instances_[object - shapes_.size()].intersect(ray, limit, first_id(object, before));
  if (!hit) return std::nullopt;
  return Hit{*hit, object};
}

// Calls visit(object, entry, limit) for each object that the ray enters at t = entry ≤ limit. `visit` returns
// the new limit; a negative one ends the search.
template <typename Visit>
void Objects::for_each_entered(const Ray& ray, double limit, const Visit& visit) const {
  for (size_t i = 0; i < unbounded_.size() && limit >= 0; ++i) limit = visit(unbounded_[i], 0.0, limit);
  if (boxes_.empty() || limit < 0) return;

  const BoxRay box_ray(ray, box_rounding * growth_ * (magnitude(ray.o) + reach_));
  bvh_.search(box_ray, limit, [&](uint32_t i, double so_far) {
    const double entry = box_ray.entry(boxes_[i]);
    return entry < infinity ? visit(bounded_[i], entry, so_far) : so_far;
  });
}

std::optional<Objects::Hit> Objects::trace(const Ray& ray, double limit, double& sure_until,
                                           const PrimitiveIds::First& before) const {
  std::optional<Hit> nearest;
  for_each_entered(ray, limit, [&](size_t object, double entry, double so_far) {
    auto hit = intersect(object, ray, so_far, before);
    if (!hit) return so_far;
    if (hit->at.iteration_limit) {
      sure_until = std::min(sure_until, hit->at.t);
      return so_far;
    }
    hit->at.t = std::max(hit->at.t, entry);
    if (nearest && !(hit->at.t < nearest->at.t || (hit->at.t == nearest->at.t && object < nearest->object)))
      return so_far;
    nearest = *hit;
    return std::min(so_far, hit->at.t);
  });
  return nearest;
}

SurfacePoint Objects::surface(const Ray& ray, const Hit& hit) const {
  return is_shape(hit.object) ? shapes_[hit.object]->surface(ray, hit.at)
                              : instances_[hit.object - shapes_.size()].surface(ray, hit.at);
}

double Objects::reach(const Hit& hit, const Vec3& eye) const {
  if (!is_shape(hit.object)) return instances_[hit.object - shapes_.size()].reach(hit.at.triangle, eye);
  const Bounds box = shapes_[hit.object]->part(hit.at).bounds();
  return finite(box) ? std::max(magnitude(box.min - eye), magnitude(box.max - eye)) : 0;
}

// The share of light that comes through one shape which the ray enters at t = entry.
double Objects::share_of_shape(size_t index, const Ray& ray, double entry, double t_end, bool& gave_up,
                               const PrimitiveIds::First& before) const {
  const Shape& shape = *shapes_[index];
  const auto share_of = [&](int material) { return materials_[size_t(material)]->shadow_transmittance(); };
  if (const double each = share_of(shape.material); shape.counts_crossings() && each > 0) {
    int crossed = 0;
    const double known_until =
        for_each_crossing(shape, ray, [&](double t, const Intersection&, const SurfacePoint&) {
          crossed += t < t_end;
          return t < t_end;
        });
    gave_up = gave_up || known_until < t_end;
    return std::pow(each, crossed / 2.0);
  }
  const auto hit = intersect_shape(index, ray, before);
  if (hit && hit->iteration_limit) {
    gave_up = gave_up || hit->t < t_end;
    return 1;
  }
  if (!hit || std::max(hit->t, entry) >= t_end) return 1;
  double share = share_of(shape.part(*hit).material);
  if (&shape.part(*hit) == &shape) return share;
  // A CSG object counts once, by the transmittance of its densest surface on the way.
  for (const auto& [in, out] : shape.spans(ray))
    for (const Intersection& crossing : {in, out}) {
      if (crossing.iteration_limit)
        gave_up = gave_up || crossing.t < t_end;
      else if (crossing.t > 0 && crossing.t < t_end)
        share = std::min(share, share_of(shape.part(crossing).material));
    }
  return share;
}

// The share of light that comes through an instance of a mesh.
double Objects::share_of_instance(size_t object, const Ray& ray, double t_end,
                                  const PrimitiveIds::First& before) const {
  const InstanceGeometry& instance = instances_[object - shapes_.size()];
  const double share = materials_[size_t(instance.material())]->shadow_transmittance();
  const uint32_t crossed =
      instance.count_crossed(ray, t_end, share == 0 ? 1 : instance.triangles(), first_id(object, before));
  return crossed == 0 ? 1 : std::pow(share, crossed / 2.0);
}

bool Objects::add_shares(const Ray& ray, double t_end, size_t space, std::vector<Share>& shares,
                         bool& gave_up, const PrimitiveIds::First& before) const {
  bool lost = false;
  for_each_entered(ray, t_end, [&](size_t object, double entry, double limit) {
    if (!(entry < t_end)) return limit;
    const double share = is_shape(object) ? share_of_shape(object, ray, entry, t_end, gave_up, before)
                                          : share_of_instance(object, ray, t_end, before);
    if (share != 1) shares.push_back({space, object, share});
    lost = share == 0;
    return lost ? -1.0 : limit;
  });
  return lost;
}

}  // namespace eyeray::engine::reference
