// The surfaces that light a scene, and how likely each light is chosen: for integrators that cast one shadow
// ray at each vertex of a path.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "host/scene/shape.hpp"

namespace eyeray {

struct Scene;

struct ParallelogramForm {
  Vec3 corner, edge_u, edge_v;
};
// Those on which a place can be chosen, in the world.
using EmitterForm = std::variant<SphereForm, DiskForm, TriangleForm, ParallelogramForm>;

struct Emitter {
  uint64_t primitive;
  Vec3 radiance;  // everywhere, on both sides
  EmitterForm form;
  double area;
};

// Of its one side.
double area_of(const EmitterForm& form);

struct LightChoice {
  std::vector<Emitter> emitters;  // in the order of their primitives
  // Scene::lights, then `emitters`: light i is chosen by the numbers below ends[i] of 2²⁴, and not below
  // those before it. Each has one at least.
  std::vector<uint32_t> ends;
  std::vector<SourcePosition> unsampled;  // of shapes and meshes that emit, and are found by chance alone

  // How likely light i is chosen.
  double share(size_t i) const { return (ends[i] - (i == 0 ? 0 : ends[i - 1])) * 0x1p-24; }
};

// By power, a sixteenth of it evenly. Error (bad_input) where more than 2²⁰ surfaces emit.
LightChoice light_choice(const Scene& scene);

}  // namespace eyeray
