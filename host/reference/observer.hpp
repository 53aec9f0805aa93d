// Observes the reference while it traces a sample, as PROBE does in shaders.
#pragma once

#include "host/core/ray_tree.hpp"
#include "host/reference/tracer.hpp"

namespace eyeray::engine::reference {

// Forwards its notifications to a recorder or, mostly, to none.
class Observer {
 public:
  Observer(RayRecorder* recorder = nullptr) : recorder_(recorder) {}
  // Records only the decisions of a random path (trail.hpp).
  explicit Observer(std::vector<uint32_t>& events) : events_(&events) {}

  // True if there is a recorder.
  explicit operator bool() const { return recorder_ != nullptr; }

  template <typename T>
  void value(std::string_view name, const T& value) const {
    if (recorder_) recorder_->value(name, 0, value);
  }
  // The following notifications belong to this ray, as in RayRecorder. `number`: for a shadow ray, the number
  // of its light.
  void ray(RayKind kind, const Ray& ray, int depth, size_t number = 0) const;
  // The following notifications belong to the last ray of `depth` again.
  void back(int depth) const;
  // The hit of the ray, and the surface there, as the shape defines it.
  void hit(const Tracer& tracer, const Ray& ray, const Hit& hit, const SurfacePoint& surface) const;
  void event(uint32_t event) const {
    if (events_) events_->push_back(event);
    value("event", event);
  }
  // The light seen by a ray that hits nothing.
  void miss(const Vec3& throughput, const Vec3& light) const;

 private:
  RayRecorder* recorder_ = nullptr;
  std::vector<uint32_t>* events_ = nullptr;
};

}  // namespace eyeray::engine::reference
