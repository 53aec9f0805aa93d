// A scene in Embree's terms. For the contenders layer alone.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "host/scene/scene.hpp"

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCGeometryTy;

namespace eyeray::engine::contenders {

struct EmbreeRelease {
  void operator()(RTCDeviceTy* device) const;
  void operator()(RTCSceneTy* scene) const;
};

// The primitives of the scene that an Embree geometry holds.
struct EmbreePart {
  int64_t first = 0;                // if `primitives` is empty: the scene's primitive of index 0
  std::vector<int64_t> primitives;  // the scene's primitive of each index; empty: consecutive from `first`
  int64_t primitive(uint32_t index) const {
    return primitives.empty() ? first + int64_t(index) : primitives[index];
  }
};

// An endless plane, n · x = d, which Embree has no primitive for.
struct EmbreePlane {
  float normal[3];
  float distance;
  int64_t primitive;
  bool opaque;
};

class EmbreeWorld {
 public:
  explicit EmbreeWorld(const Scene& scene);

  // all(): the scene in which nearest hits are searched. opaque(): the scene of occluders, which let no light
  // through.
  RTCSceneTy* all() const { return all_.get(); }
  RTCSceneTy* opaque() const { return opaque_ ? opaque_.get() : all_.get(); }

  std::vector<EmbreePart> parts;  // by Embree's geometry id
  std::vector<EmbreePlane> planes;
  double build_seconds = 0;
  std::atomic<int64_t> bytes = 0;

 private:
  void add_shapes(const Scene& scene);
  void add_meshes(const Scene& scene);
  // Takes ownership of the geometry.
  void attach(RTCGeometryTy* geometry, EmbreePart part, bool opaque);

  std::unique_ptr<RTCDeviceTy, EmbreeRelease> device_;
  std::unique_ptr<RTCSceneTy, EmbreeRelease> all_, opaque_;
  std::vector<std::unique_ptr<RTCSceneTy, EmbreeRelease>> meshes_;  // the meshes with several instances
};

}  // namespace eyeray::engine::contenders
