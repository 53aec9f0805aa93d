// Looks on while the reference traces a sample, as PROBE does in shaders.
#pragma once

#include "host/core/ray_tree.hpp"
#include "host/reference/tracer.hpp"

namespace eyeray::engine::reference {

// Shows what it is told to a recorder, or, mostly, to none.
class Observer {
 public:
  Observer(RayRecorder* recorder = nullptr) : recorder_(recorder) {}
  // Takes what a random path decides alone (trail.hpp).
  explicit Observer(std::vector<uint32_t>& events) : events_(&events) {}

  // Whether anybody looks.
  explicit operator bool() const { return recorder_ != nullptr; }

  template <typename T>
  void value(std::string_view name, const T& value) const {
    if (recorder_) recorder_->value(name, 0, value);
  }
  // What follows belongs to this ray, as RayRecorder has it; of a shadow ray `number` is its light's.
  void ray(RayKind kind, const Ray& ray, int depth, size_t number = 0) const;
  // What follows belongs to the last ray of `depth` again.
  void back(int depth) const;
  // What the ray hit, and the surface there, as the shape has it.
  void hit(const Tracer& tracer, const Ray& ray, const Hit& hit, const SurfacePoint& surface) const;
  void event(uint32_t event) const {
    if (events_) events_->push_back(event);
    value("event", event);
  }
  // What a ray that hits nothing sees.
  void miss(const Vec3& throughput, const Vec3& light) const;

 private:
  RayRecorder* recorder_ = nullptr;
  std::vector<uint32_t>* events_ = nullptr;
};

}  // namespace eyeray::engine::reference
