// Every shader function, compiled as C++ into the .cpp that includes this; the loaders read the scene that a
// Binding of this thread names. For the twin, built in or made of a user's files, and for tests of single
// functions.
#pragma once

#include <type_traits>

#include "host/twin/scene_view.hpp"

namespace eyeray::engine::shader {
namespace {

thread_local const twin::SceneView* bound_scene = nullptr;
thread_local const twin::Spectator* bound_spectator = nullptr;
thread_local const twin::PhotonSink* bound_sink = nullptr;
thread_local uint32_t counted_iterations = 0;

// Lets shader functions on this thread read `scene` for its lifetime, and show PROBEd values to
// `spectator`, if there is one, and store photons in `sink`.
class Binding {
 public:
  explicit Binding(const twin::SceneView& scene, const twin::Spectator* spectator = nullptr,
                   const twin::PhotonSink* sink = nullptr)
      : scene_(scene) {
    bound_scene = &scene_;
    bound_spectator = spectator;
    bound_sink = sink;
    counted_iterations = 0;
  }
  ~Binding() {
    bound_scene = nullptr;
    bound_spectator = nullptr;
    bound_sink = nullptr;
  }
  Binding(const Binding&) = delete;
  Binding& operator=(const Binding&) = delete;

 private:
  twin::SceneView scene_;
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
// The formula's number if its surface is found in this way, else NONE.
[[maybe_unused]] uint if_bounded(uint number, bool bounded) {
  return bound_scene->formulas.by_bounds(bound_scene->formulas.scene, number) == bounded ? number : NONE;
}
// Checks for interruption: each ray that hits loads a material, and a pixel may have endless rays.
[[maybe_unused]] const Material& load_material(uint i) {
  bound_scene->stop_if_interrupted();
  return bound_scene->materials[i];
}
[[maybe_unused]] const Texture& load_texture(uint i) {
  return bound_scene->textures[i];
}
[[maybe_unused]] uint load_texel(uint i) {
  return bound_scene->texels[i];
}
[[maybe_unused]] const uvec4& load_environment(uint i) {
  return bound_scene->environment[i];
}
[[maybe_unused]] const Medium& load_medium(uint i) {
  return bound_scene->media[i];
}
[[maybe_unused]] const Light& load_light(uint i) {
  return bound_scene->lights[i];
}
[[maybe_unused]] const Emitter& load_emitter(uint i) {
  return bound_scene->emitters[i];
}
[[maybe_unused]] const LightNode& load_light_node(uint i) {
  return bound_scene->light_nodes[i];
}
[[maybe_unused]] vec4 load_albedo(uint i) {
  return i < bound_scene->albedo_count ? bound_scene->albedos[i] : vec4(0);
}
[[maybe_unused]] uint load_emitter_media(uint i) {
  return bound_scene->emitter_media[i];
}
[[maybe_unused]] const PhotonPass& load_photon_pass() {
  return *bound_scene->photon_pass;
}
[[maybe_unused]] const vec4& load_photon_target(uint i) {
  return bound_scene->photon_pass->targets[i];
}
[[maybe_unused]] const Photon& load_photon(uint i) {
  return bound_scene->photons[i];
}
[[maybe_unused]] uint load_photon_cell(uint key) {
  return bound_scene->photon_cells[key];
}
[[maybe_unused]] void store_photon(const Photon& photon) {
  bound_sink->store(bound_sink->to, photon);
}

// Stands in the condition of each loop of a user's shaders. Debuggers step over it.
[[maybe_unused, gnu::always_inline, gnu::artificial]] inline bool may_iterate(uint loop) {
  if (++counted_iterations == bound_scene->loops.most)
    bound_scene->loops.stop(bound_scene->loops.guard, loop);
  return true;
}

// PROBE, if there is a spectator.
template <typename T>
void show(const char* name, uint line, const T& shown) {
  double numbers[4] = {};
  if constexpr (std::is_arithmetic_v<T>) {
    numbers[0] = double(shown);
    const uint type = std::is_same_v<T, bool> ? PROBE_BOOL : std::is_integral_v<T> ? PROBE_INT : PROBE_FLOAT;
    bound_spectator->value(bound_spectator->recorder, name, line, type, 1, numbers);
  } else {
    for (int i = 0; i < T::length(); ++i) numbers[i] = double(shown[i]);
    bound_spectator->value(bound_spectator->recorder, name, line, PROBE_FLOAT, T::length(), numbers);
  }
}

}  // namespace
}  // namespace eyeray::engine::shader

// Definitions that a specialised kernel gets from its generated scene.glsl, here for every scene
// (shaders/kernels/features.h).
#define KIND_FIRST(name) bound_scene->first_linear(KIND_##name)
#define KIND_END(name) bound_scene->linear_ends[KIND_##name]
#define LIGHT_COUNT bound_scene->frame->light_count
#define EMITTER_COUNT bound_scene->frame->emitter_count
#define ANY_PANE bound_scene->panes
#define ANY_INTERFACE bound_scene->interfaces
#define IS_TRANSPARENT bound_scene->transparent
#define HAS_ENVIRONMENT_LIGHT (bound_scene->frame->environment_numbers > 0u)
#define TRIANGLE_METHOD bound_scene->frame->triangle_method
#define HAS_BVH bound_scene->has_bvh
#define QUANTISED_NODES bound_scene->quantised_nodes
#define IMMEDIATE_SHAPES SHAPES
#define TEXTURES_OF(name, X) TEXTURES(X)
#define ALPHA_TESTED_SHAPES SHAPES
#define INSTANCE_COUNT bound_scene->instance_count
#define LOOP_PROBE bound_scene->frame->loop_probe
#define CAMERA_IS(number) (bound_scene->frame->camera == number)
#define SAMPLER_IS(number) (bound_scene->frame->pattern == number)
#define INTEGRATOR_IS(number) (bound_scene->frame->integrator == number)
// One march of each kind for all formulas.
#define FORMULAS(X) X(if_bounded(it.formula, false), stepped) X(if_bounded(it.formula, true), bounded)
#define FORMULA_VALUE(it, p) bound_scene->formulas.value(bound_scene->formulas.scene, it.formula, p)
#define FORMULA_HAS_GRADIENT(it) bound_scene->formulas.has_gradient(bound_scene->formulas.scene, it.formula)
#define FORMULA_GRADIENT(it, p) bound_scene->formulas.gradient(bound_scene->formulas.scene, it.formula, p)
#define FORMULA_BOUND(it, x, y, z) \
  bound_scene->formulas.bound(bound_scene->formulas.scene, it.formula, x, y, z)
#define FORMULA_DUAL(it, p) bound_scene->formulas.dual(bound_scene->formulas.scene, it.formula, p)
#define FORMULA_DIRECTION(number, at) bound_scene->formulas.direction(bound_scene->formulas.scene, number, at)
#define FORMULA_ORIGIN(number, at) bound_scene->formulas.origin(bound_scene->formulas.scene, number, at)
#define FORMULA_COLOR(number, uv) bound_scene->formulas.color(bound_scene->formulas.scene, number, uv)

#undef PROBE
#undef PROBE_RAY
#undef PROBE_BACK
#define PROBE(name, shown) (bound_spectator ? show(#name, __LINE__, shown) : void())
#define PROBE_RAY(kind, number, depth) \
  (bound_spectator ? bound_spectator->ray(bound_spectator->recorder, kind, number, depth) : void())
#define PROBE_BACK(depth) (bound_spectator ? bound_spectator->back(bound_spectator->recorder, depth) : void())

#ifdef EYERAY_USERS_TWIN
#include "host/twin/glsl_functions.hpp"
#endif

#include "kernels/features.h"

#include "host/core/local_shaders.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
// Functions that a dispatch calls must precede it.
// clang-format off
#include "shapes/implicit/search.glsl"
#define FORMULA_NAME(part) stepped_##part
#include "shapes/implicit/lipschitz_march.glsl"
#undef FORMULA_NAME
#define FORMULA_NAME(part) bounded_##part
#include "shapes/implicit/bounded_search.glsl"
#undef FORMULA_NAME
#include "textures/all.glsl"
#include "bsdf/all.glsl"
#include "shapes/all.glsl"
#include "materials/all.glsl"
#include "cameras/all.glsl"
#include "samplers/all.glsl"
#include "lights/all.glsl"
#include "emitters/all.glsl"
#include "integrators/all.glsl"
#include "integrators/photon.glsl"
#include "kernels/pixel.glsl"
#include "kernels/cooperative/shaft.glsl"
// clang-format on
#pragma GCC diagnostic pop
