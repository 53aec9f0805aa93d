// Every shader function, compiled as C++ into the .cpp that includes this; the loaders read the PackedScene
// that a Binding of this thread names. For the twin and for tests of single functions.
#pragma once

#include "records/packer.hpp"

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
[[maybe_unused]] const Material& load_material(uint i) {
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
#define HAS_HOLES 1
#define SHAPES_WITH_HOLES SHAPES
#define HAS_MEDIA 1
#define HAS_ABSORPTION 1
#define UV_OF(name) true

#undef SHADER_BEGIN
#undef SHADER_END
#define SHADER_BEGIN         \
  namespace eyeray::shader { \
  namespace {
#define SHADER_END \
  }                \
  }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
// What is dispatched to stands before the dispatch.
// clang-format off
#include "shapes/all.glsl"
#include "materials/all.glsl"
#include "integrators/all.glsl"
#include "pixel.glsl"
#include "shaft.glsl"
// clang-format on
#pragma GCC diagnostic pop
