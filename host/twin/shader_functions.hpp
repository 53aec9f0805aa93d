// Every shader function, compiled as C++ into the .cpp that includes this; the loaders read the PackedScene
// that a Binding of this thread names. For the twin and for tests of single functions.
#pragma once

#include <array>

#include "host/core/ray_tree.hpp"
#include "host/core/termination.hpp"
#include "host/formula/formula.hpp"
#include "host/records/packer.hpp"
#include "host/twin/straight_line.hpp"

namespace eyeray::shader {
namespace {

thread_local const records::PackedScene* bound_scene = nullptr;
thread_local RayRecorder* bound_recorder = nullptr;

// Lets shader functions on this thread read `scene` for its lifetime, and show what they PROBE to `recorder`,
// if there is one.
class Binding {
 public:
  explicit Binding(const records::PackedScene& scene, RayRecorder* recorder = nullptr) {
    bound_scene = &scene;
    bound_recorder = recorder;
  }
  ~Binding() {
    bound_scene = nullptr;
    bound_recorder = nullptr;
  }
  Binding(const Binding&) = delete;
  Binding& operator=(const Binding&) = delete;
};

[[maybe_unused]] const Primitive& load_primitive(uint i) {
  return bound_scene->primitives[i];
}
[[maybe_unused]] const uvec4& load_vertex(uint i) {
  return bound_scene->vertices[i];
}
[[maybe_unused]] const uvec4& load_outline(uint i) {
  return bound_scene->vertices[i];
}
[[maybe_unused]] const uvec4& load_node(uint i) {
  return bound_scene->nodes[i];
}
[[maybe_unused]] const Bvh& load_bvh(uint i) {
  return bound_scene->bvhs[i];
}
[[maybe_unused]] const Instance& load_instance(uint i) {
  return bound_scene->instances[i];
}
[[maybe_unused]] float load_formula_value(uint number, const vec3& p) {
  return bound_scene->formulas[number].formula->value(std::array{p.x, p.y, p.z});
}
[[maybe_unused]] vec3 load_formula_bound(uint number, const vec3& x, const vec3& y, const vec3& z) {
  return twin::affine_bound(bound_scene->formulas[number].formula->straight_line(), x, y, z);
}
[[maybe_unused]] vec4 load_formula_dual(uint number, const vec3& p) {
  return twin::differentiate(bound_scene->formulas[number].formula->straight_line(), p);
}
// The formula's number if it is found that way, else none.
[[maybe_unused]] uint if_bounded(uint number, bool bounded) {
  return bound_scene->formulas[number].by_bounds == bounded ? number : NONE;
}
[[maybe_unused]] vec3 load_formula_gradient(uint number, const vec3& p) {
  const std::array<float, 3> gradient =
      bound_scene->formulas[number].formula->gradient(std::array{p.x, p.y, p.z});
  return {gradient[0], gradient[1], gradient[2]};
}
[[maybe_unused]] vec3 load_formula_color(uint number, const vec2& uv) {
  const std::array<float, 3> color = bound_scene->formulas[number].formula->color(std::array{uv.x, uv.y});
  return {color[0], color[1], color[2]};
}
// Each ray that hits asks for one, and a pixel may have rays without end.
[[maybe_unused]] const Material& load_material(uint i) {
  stop_if_interrupted();
  return bound_scene->materials[i];
}
[[maybe_unused]] const Texture& load_texture(uint i) {
  return bound_scene->textures[i];
}
[[maybe_unused]] uint load_texel(uint i) {
  return bound_scene->texels[i];
}
[[maybe_unused]] const Medium& load_medium(uint i) {
  return bound_scene->media[i];
}
[[maybe_unused]] const Light& load_light(uint i) {
  return bound_scene->lights[i];
}

}  // namespace
}  // namespace eyeray::shader

// What a specialised kernel gets from its generated scene.glsl, here for every scene
// (shaders/kernels/features.h).
#define KIND_FIRST(name) bound_scene->first_linear(KIND_##name)
#define KIND_END(name) bound_scene->linear_ends[KIND_##name]
#define LIGHT_COUNT bound_scene->frame.light_count
#define TRIANGLE_METHOD bound_scene->frame.triangle_method
#define HAS_BVH bound_scene->has_bvh
#define QUANTISED_NODES bound_scene->quantised_nodes
#define IMMEDIATE_SHAPES SHAPES
#define ALPHA_TESTED_SHAPES SHAPES
#define INSTANCE_COUNT uint(bound_scene->instances.size())
#define LOOP_PROBE bound_scene->frame.loop_probe
#define CAMERA_IS(number) (bound_scene->frame.camera == number)
#define SAMPLER_IS(number) (bound_scene->frame.pattern == number)
#define INTEGRATOR_IS(number) (bound_scene->frame.integrator == number)
// One march of each kind for all formulas.
#define FORMULAS(X) X(if_bounded(it.formula, false), stepped) X(if_bounded(it.formula, true), bounded)
#define FORMULA_VALUE(it, p) load_formula_value(it.formula, p)
#define FORMULA_HAS_GRADIENT(it) bound_scene->formulas[it.formula].formula->has_gradient()
#define FORMULA_GRADIENT(it, p) load_formula_gradient(it.formula, p)
#define FORMULA_BOUND(it, x, y, z) load_formula_bound(it.formula, x, y, z)
#define FORMULA_DUAL(it, p) load_formula_dual(it.formula, p)
#define FORMULA_COLOR(number, uv) load_formula_color(number, uv)

#undef PROBE
#undef PROBE_RAY
#undef PROBE_BACK
#define PROBE(name, shown) (bound_recorder ? bound_recorder->value(#name, __LINE__, shown) : void())
#define PROBE_RAY(kind, number, depth) \
  (bound_recorder ? bound_recorder->ray(RayKind(kind), number, depth) : void())
#define PROBE_BACK(depth) (bound_recorder ? bound_recorder->back(depth) : void())

#include "shaders/kernels/features.h"

#include "host/core/local_shaders.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
// What is dispatched to stands before the dispatch.
// clang-format off
#include "shaders/shapes/implicit/search.glsl"
#define FORMULA_NAME(part) stepped_##part
#include "shaders/shapes/implicit/lipschitz_march.glsl"
#undef FORMULA_NAME
#define FORMULA_NAME(part) bounded_##part
#include "shaders/shapes/implicit/bounded_search.glsl"
#undef FORMULA_NAME
#include "textures/all.glsl"
#include "shapes/all.glsl"
#include "materials/all.glsl"
#include "cameras/all.glsl"
#include "samplers/all.glsl"
#include "lights/all.glsl"
#include "integrators/all.glsl"
#include "shaders/kernels/pixel.glsl"
#include "shaders/kernels/cooperative/shaft.glsl"
// clang-format on
#pragma GCC diagnostic pop
