// The surfaces that light a scene, for integrators that choose points on them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "host/scene/emitter_form.hpp"

namespace eyeray::engine {

class Material;
struct TextureContext;
struct Scene;

// The values at a triangle's corners on which its light depends.
struct EmitterCorners {
  std::array<Vec2, 3> uv, second_uv;
  std::array<Vec3, 3> colors;
};

struct Emitter {
  uint64_t primitive;
  Vec3 radiance;  // the same everywhere; if it varies, about its mean
  EmitterForm form;
  double area;
  // 1: light leaves only the side that normals point to; −1: only the other side; 0: both sides
  double side = 0;
  int material = 0;                                         // index in Scene::materials
  bool varies = false;                                      // the radiance depends on uv, position and colour
  std::shared_ptr<const EmitterCorners> corners = nullptr;  // for a triangle whose radiance varies
};

// The emitting surfaces of a scene.
struct Emitters {
  std::vector<Emitter> sampled;           // in the order of their primitives
  std::vector<SourcePosition> unsampled;  // the emitting shapes and meshes that only random paths find
};

// Error (bad_input) where more than 2²⁰ surfaces emit.
Emitters emitters(const Scene& scene);

// The radiance emitted at a point of a surface.
Vec3 emitted(const Material& material, const TextureContext& point, const Vec3& color);

}  // namespace eyeray::engine
