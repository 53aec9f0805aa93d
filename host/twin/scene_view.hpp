// A scene, and the spectator of its rays, as the twin's shader functions see them. Both are plain data and
// plain functions, so that another compiler may have made the other side (executors/twin_module.hpp).
#pragma once

#include "host/records/records.hpp"

namespace eyeray::engine::twin {

// The scene's formulas, by number. Each function is given `scene`.
struct FormulaView {
  const void* scene;
  float (*value)(const void* scene, uint32_t number, const shader::vec3& p);
  shader::vec3 (*gradient)(const void* scene, uint32_t number, const shader::vec3& p);
  shader::vec3 (*bound)(const void* scene, uint32_t number, const shader::vec3& x, const shader::vec3& y,
                        const shader::vec3& z);
  shader::vec4 (*dual)(const void* scene, uint32_t number, const shader::vec3& p);
  shader::vec3 (*color)(const void* scene, uint32_t number, const shader::vec2& uv);
  shader::vec3 (*direction)(const void* scene, uint32_t number, const shader::vec4& at);
  shader::vec3 (*origin)(const void* scene, uint32_t number, const shader::vec4& at);
  bool (*has_gradient)(const void* scene, uint32_t number);
  bool (*by_bounds)(const void* scene, uint32_t number);
};

// Loops of a user's shaders, which the twin counts: `stop` throws once loops of one invocation have made
// `most` iterations. It is given `guard`, and the bit of the loop that made the last one
// (executors/loop_guard.hpp).
struct LoopView {
  const void* guard;
  uint32_t most;
  void (*stop)(const void* guard, uint32_t loop);
};

// A view of records::PackedScene.
struct SceneView {
  const shader::Frame* frame;
  const shader::Primitive* primitives;
  const uint32_t* linear_ends;
  const shader::uvec4* vertices;
  const shader::uvec4* nodes;
  const shader::Bvh* bvhs;
  const shader::Instance* instances;
  uint32_t instance_count;
  const shader::Material* materials;
  const shader::Texture* textures;
  const uint32_t* texels;
  const shader::uvec4* environment;
  const shader::Medium* media;
  const shader::Light* lights;
  const shader::Emitter* emitters;
  const shader::LightNode* light_nodes;
  const uint32_t* emitter_media;
  const shader::vec4* albedos;
  uint32_t albedo_count;  // albedos of lobes that the scene lacks are left out
  bool has_bvh, quantised_nodes, panes, interfaces, transparent;
  // The photons of the current sample, set by the code that traces them.
  const shader::PhotonPass* photon_pass;
  const shader::Photon* photons;
  const uint32_t* photon_cells;
  FormulaView formulas;
  LoopView loops;
  void (*stop_if_interrupted)();  // throws

  // The index of the first primitive of `kind` that is in no BVH.
  uint32_t first_linear(uint32_t kind) const { return kind == 0 ? 0 : linear_ends[kind - 1]; }
};

// Gets the records that a photon leaves behind.
struct PhotonSink {
  void* to;
  void (*store)(void* to, const shader::Photon& photon);
};

// Receives the values that shaders PROBE. Each function gets `recorder`.
struct Spectator {
  void* recorder;
  // A number, truth or vector; `type` as PROBE_FLOAT … of records.h.
  void (*value)(void* recorder, const char* name, uint32_t line, uint32_t type, int size,
                const double* numbers);
  void (*ray)(void* recorder, uint32_t kind, uint32_t number, uint32_t depth);
  void (*back)(void* recorder, uint32_t depth);
};

// The twin, for one pixel or ray. Thread-safe.
struct Functions {
  // Computes a pixel of the whole picture like kernels/render.comp.glsl. `spectator`: null if nothing is
  // recorded.
  shader::SampleResult (*sample)(const SceneView& scene, uint32_t x, uint32_t y, uint32_t index,
                                 const Spectator* spectator);
  shader::AuxiliaryResult (*auxiliary)(const SceneView& scene, uint32_t x, uint32_t y, uint32_t index);
  shader::HitResult (*first_hit)(const SceneView& scene, uint32_t x, uint32_t y);
  // Computes photon `number` of sample `index` like kernels/photons.comp.glsl.
  shader::PhotonResult (*photon)(const SceneView& scene, uint32_t index, uint32_t number,
                                 const PhotonSink& sink);
  // Computes the hit of one ray like kernels/query.comp.glsl.
  shader::QueryHit (*query)(const SceneView& scene, const shader::QueryRay& ray, bool any);
};

}  // namespace eyeray::engine::twin
