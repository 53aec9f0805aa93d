#include "reference/tracer.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::reference {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool finite(const Bounds& bounds) {
  return magnitude(bounds.min) < infinity && magnitude(bounds.max) < infinity;
}

}  // namespace

Tracer::Tracer(const Scene& scene, Acceleration acceleration) : scene_(scene) {
  for (const Mesh& mesh : scene.meshes) meshes_.emplace_back(mesh, acceleration);
  uint64_t primitives = scene.shapes.size();
  for (const Instance& instance : scene.instances) {
    const auto& mask = scene.materials[size_t(instance.material)]->mask;
    instances_.emplace_back(instance, meshes_[size_t(instance.mesh)], mask ? &*mask : nullptr);
    first_primitives_.push_back(primitives);
    primitives += instances_.back().triangles();
  }

  const auto add = [&](size_t body, const Bounds& box) {
    bounded_.push_back(uint32_t(body));
    boxes_.push_back(box);
    reach_ = std::max({reach_, magnitude(box.min), magnitude(box.max)});
  };
  for (size_t i = 0; i < scene.shapes.size(); ++i) {
    const Bounds box = scene.shapes[i]->bounds();
    if (finite(box)) {
      add(i, box);
    } else {
      unbounded_.push_back(uint32_t(i));
    }
  }
  for (size_t i = 0; i < instances_.size(); ++i) {
    if (instances_[i].triangles() == 0) continue;
    add(scene.shapes.size() + i, instances_[i].bounds());
    reach_ = std::max(reach_, instances_[i].reach());
    growth_ = std::max(growth_, instances_[i].growth());
  }
  tree_ = BoxTree(
      uint32_t(boxes_.size()), [this](uint32_t i) { return boxes_[i]; }, acceleration);
}

int Tracer::material(size_t body, const Intersection& hit) const {
  const size_t shapes = scene_.shapes.size();
  return body < shapes ? scene_.shapes[body]->part(hit).material : instances_[body - shapes].material();
}

// A hole is not met, and behind it there is nothing more of a shape that may have one.
std::optional<Intersection> Tracer::intersect_shape(size_t index, const Ray& ray) const {
  const Shape& shape = *scene_.shapes[index];
  const auto hit = shape.intersect(ray);
  const auto& mask = scene_.materials[size_t(shape.material)]->mask;
  if (hit && mask && !mask->covers(shape.surface(ray, *hit).uv)) return std::nullopt;
  return hit;
}

std::optional<TriangleHit> Tracer::intersect(size_t body, const Ray& ray, double limit) const {
  const size_t shapes = scene_.shapes.size();
  if (body >= shapes) return instances_[body - shapes].intersect(ray, limit);
  const auto hit = intersect_shape(body, ray);
  if (!hit) return std::nullopt;
  return TriangleHit{*hit};
}

// Calls visit(body, entry, limit) for the bodies that the ray enters at t = entry ≤ limit; it returns the
// limit from there on, a negative one to end the search.
template <typename Visit>
void Tracer::for_each_entered(const Ray& ray, double limit, const Visit& visit) const {
  for (size_t i = 0; i < unbounded_.size() && limit >= 0; ++i) limit = visit(unbounded_[i], 0.0, limit);
  if (boxes_.empty() || limit < 0) return;

  const BoxRay box_ray(ray, rounding * growth_ * (magnitude(ray.o) + reach_));
  tree_.search(box_ray, limit, [&](uint32_t i, double so_far) {
    const double entry = box_ray.entry(boxes_[i]);
    return entry < infinity ? visit(bounded_[i], entry, so_far) : so_far;
  });
}

std::optional<Hit> Tracer::trace(const Ray& ray) const {
  uint32_t flags = 0;
  return trace(ray, flags);
}

std::optional<Hit> Tracer::trace(const Ray& ray, uint32_t& flags) const {
  std::optional<Hit> nearest;
  double sure_until = infinity;
  for_each_entered(ray, infinity, [&](size_t body, double entry, double limit) {
    auto hit = intersect(body, ray, limit);
    if (!hit) return limit;
    if (hit->ran_out) {
      sure_until = std::min(sure_until, hit->t);
      return limit;
    }
    hit->t = std::max(hit->t, entry);
    if (nearest && !(hit->t < nearest->at.t || (hit->t == nearest->at.t && body < nearest->body)))
      return limit;
    nearest = {*hit, body, body, material(body, *hit)};
    return hit->t;
  });
  if (sure_until < (nearest ? nearest->at.t : infinity)) flags |= ran_out;
  if (nearest && nearest->body >= scene_.shapes.size())
    nearest->primitive = first_primitives_[nearest->body - scene_.shapes.size()] + nearest->at.triangle;
  return nearest;
}

SurfacePoint Tracer::surface(const Ray& ray, const Hit& hit) const {
  const size_t shapes = scene_.shapes.size();
  return hit.body < shapes ? scene_.shapes[hit.body]->surface(ray, hit.at)
                           : instances_[hit.body - shapes].surface(ray, hit.at);
}

double Tracer::reach(const Hit& hit, const Vec3& eye) const {
  const size_t shapes = scene_.shapes.size();
  if (hit.body >= shapes) return instances_[hit.body - shapes].reach(hit.at.triangle, eye);
  const Bounds box = scene_.shapes[hit.body]->part(hit.at).bounds();
  return finite(box) ? std::max(magnitude(box.min - eye), magnitude(box.max - eye)) : 0;
}

// The share of light that comes through one body which the ray enters at t = entry.
double Tracer::share_let_through(size_t body, const Ray& ray, double entry, double t_end,
                                 bool& gave_up) const {
  if (body < scene_.shapes.size()) {
    const Shape& shape = *scene_.shapes[body];
    if (const double each = scene_.materials[size_t(shape.material)]->shadow_transmittance();
        shape.counts_crossings() && each > 0) {
      int crossed = 0;
      const double told =
          for_each_crossing(shape, ray, [&](double t, const Intersection&, const SurfacePoint&) {
            crossed += t < t_end;
            return t < t_end;
          });
      gave_up = gave_up || told < t_end;
      return std::pow(each, crossed / 2.0);
    }
    const auto share_at = [&](const Intersection& hit) {
      return scene_.materials[size_t(shape.part(hit).material)]->shadow_transmittance();
    };
    const auto hit = intersect_shape(body, ray);
    if (hit && hit->ran_out) {
      gave_up = gave_up || hit->t < t_end;
      return 1;
    }
    if (!hit || std::max(hit->t, entry) >= t_end) return 1;
    double share = share_at(*hit);
    if (&shape.part(*hit) == &shape) return share;
    // A solid counts once, by what its densest surface on the way lets through.
    for (const auto& [in, out] : shape.spans(ray))
      for (const Intersection& crossing : {in, out})
        if (crossing.t > 0 && crossing.t < t_end) share = std::min(share, share_at(crossing));
    return share;
  }
  const InstanceGeometry& instance = instances_[body - scene_.shapes.size()];
  const double share = scene_.materials[size_t(instance.material())]->shadow_transmittance();
  const uint32_t crossed = instance.count_crossed(ray, t_end, share == 0 ? 1 : instance.triangles());
  return crossed == 0 ? 1 : std::pow(share, crossed / 2.0);
}

double Tracer::transmittance(const Ray& ray, double t_end, uint32_t& flags) const {
  // Collect the shares first: a product depends on the order of its factors.
  std::vector<std::pair<size_t, double>> shares;
  bool any_gave_up = false;
  for_each_entered(ray, t_end, [&](size_t body, double entry, double limit) {
    if (!(entry < t_end)) return limit;
    const double share = share_let_through(body, ray, entry, t_end, any_gave_up);
    if (share != 1) shares.emplace_back(body, share);
    return share == 0 ? -1.0 : limit;
  });
  std::sort(shares.begin(), shares.end());
  double product = 1;
  for (const auto& [body, share] : shares) product *= share;
  if (any_gave_up && product > 0) flags |= ran_out;
  return product;
}

Vec3 departure(const SurfacePoint& point, const Vec3& d, double least, bool along_normal) {
  const double offset = std::max(4 * point.position_error, least);
  const double cosine = glm::dot(d, point.normal_geometric);
  if (!along_normal && std::fabs(cosine) > 0.125) return point.position + d * (offset / std::fabs(cosine));
  return point.position + point.normal_geometric * (cosine >= 0 ? offset : -offset);
}

}  // namespace eyeray::reference
