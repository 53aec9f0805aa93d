// Every shader function, compiled as C++ into the .cpp that includes this; the loaders read the PackedScene
// that a Binding of this thread names. For the twin and for tests of single functions.
#pragma once

#include <array>

#include "core/termination.hpp"
#include "formula/formula.hpp"
#include "records/packer.hpp"
#include "twin/straight_line.hpp"

namespace eyeray::shader {
namespace {

thread_local const PackedScene* bound_scene = nullptr;

// Lets shader functions on this thread read `scene` for its lifetime.
class Binding {
 public:
  explicit Binding(const PackedScene& scene) { bound_scene = &scene; }
  ~Binding() { bound_scene = nullptr; }
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
[[maybe_unused]] const Tree& load_tree(uint i) {
  return bound_scene->trees[i];
}
[[maybe_unused]] const Instance& load_instance(uint i) {
  return bound_scene->instances[i];
}
[[maybe_unused]] float load_formula_value(uint number, const vec3& p) {
  return bound_scene->formulas[number].formula->value(std::array{p.x, p.y, p.z});
}
[[maybe_unused]] vec3 load_formula_enclosure(uint number, const vec3& x, const vec3& y, const vec3& z) {
  return enclose(bound_scene->formulas[number].formula->straight_line(), x, y, z);
}
[[maybe_unused]] vec4 load_formula_dual(uint number, const vec3& p) {
  return differentiate(bound_scene->formulas[number].formula->straight_line(), p);
}
// The formula's number if it is found that way, else none.
[[maybe_unused]] uint if_enclosed(uint number, bool enclosed) {
  return bound_scene->formulas[number].enclosed == enclosed ? number : NONE;
}
[[maybe_unused]] vec3 load_formula_gradient(uint number, const vec3& p) {
  const std::array<float, 3> gradient =
      bound_scene->formulas[number].formula->gradient(std::array{p.x, p.y, p.z});
  return {gradient[0], gradient[1], gradient[2]};
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

// What a specialised kernel gets from its generated scene.glsl, here for every scene.
#define KIND_FIRST(name) bound_scene->first_loose(KIND_##name)
#define KIND_END(name) bound_scene->loose_ends[KIND_##name]
#define LIGHT_COUNT bound_scene->frame.counts.x
#define TRIANGLE_METHOD bound_scene->frame.counts.w
#define HAS_TREE bound_scene->has_tree
#define QUANTISED_NODES bound_scene->quantised_nodes
#define TREE_HOLDS(number, primitive) (kind_of(primitive) == number)
#define HAS_INSTANCES 1
#define HAS_SLOW_SHAPES 0
#define QUICK_SHAPES SHAPES
#define INSTANCE_COUNT uint(bound_scene->instances.size())
#define STORED_HITS 0
#define STEPS_MAY_RUN_OUT 1
#define HAS_SECONDARY 1
#define RAY_KINDS 1
#define SHIFT_STACK 0
#define STACK_SIZE 128
#define TRACE_ITERATIONS 0u
#define LOOP_PROBE bound_scene->frame.counts.y
#define WHITTED_STACK 64
#define HAS_CHECKER 1
#define HAS_IMAGES 1
#define HAS_COLORS 1
#define HAS_EMISSION 1
#define HAS_SOLIDS 1
#define HAS_MIXED_SOLIDS 1
#define HAS_HOLES 1
#define SHAPES_WITH_HOLES SHAPES
#define HAS_MEDIA 1
#define HAS_ABSORPTION 1
#define UV_OF(name) true
// One march of each kind for all formulas.
#define FORMULAS(X) X(if_enclosed(it.formula, false), stepped) X(if_enclosed(it.formula, true), enclosed)
#define FORMULA_VALUE(it, p) load_formula_value(it.formula, p)
#define FORMULA_HAS_GRADIENT(it) bound_scene->formulas[it.formula].formula->has_gradient()
#define FORMULA_GRADIENT(it, p) load_formula_gradient(it.formula, p)
#define FORMULA_ENCLOSURE(it, x, y, z) load_formula_enclosure(it.formula, x, y, z)
#define FORMULA_DUAL(it, p) load_formula_dual(it.formula, p)

#include "core/local_shaders.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
// What is dispatched to stands before the dispatch.
// clang-format off
#include "implicit.glsl"
#define FORMULA_NAME(part) stepped_##part
#include "implicit_march.glsl"
#undef FORMULA_NAME
#define FORMULA_NAME(part) enclosed_##part
#include "implicit_enclosed.glsl"
#undef FORMULA_NAME
#include "shapes/all.glsl"
#include "materials/all.glsl"
#include "integrators/all.glsl"
#include "pixel.glsl"
#include "shaft.glsl"
// clang-format on
#pragma GCC diagnostic pop
