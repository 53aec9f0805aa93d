#include "host/reference/observer.hpp"

namespace eyeray::engine::reference {

void Observer::ray(RayKind kind, const Ray& ray, int depth, size_t number) const {
  if (!recorder_) return;
  recorder_->ray(kind, uint32_t(number), uint32_t(depth));
  value("origin", ray.o);
  value("direction", ray.d);
}

void Observer::back(int depth) const {
  if (recorder_) recorder_->back(uint32_t(depth));
}

void Observer::hit(const Tracer& tracer, const Ray& ray, const Hit& hit, const SurfacePoint& surface) const {
  if (!recorder_) return;
  value("primitive", int64_t(hit.primitive));
  value("t", hit.at.t);
  value("position", surface.position);
  value("normal_geometric", surface.normal_geometric);
  value("normal", surface.normal);
  value("uv", surface.uv);
  value("front", glm::dot(ray.d, surface.normal_geometric) < 0);
  value("material", hit.material);
  value("t_scale", tracer.t_scale(ray, hit, surface));
}

void Observer::miss(const Vec3& throughput, const Vec3& light) const {
  value("primitive", -1);
  value("throughput", throughput);
  value("light", light);
}

}  // namespace eyeray::engine::reference
