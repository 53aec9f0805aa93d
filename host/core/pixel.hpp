// The results of executors for a pixel, by which they are compared.
#pragma once

#include <cstdint>
#include <limits>

#include "host/core/vec.hpp"

namespace eyeray::engine {

// One sample of one pixel. Float32 executors widen exactly, so that bits survive.
struct PixelSample {
  Vec3 color{0.0};     // linear RGB, unclipped
  uint32_t rays = 0;   // rays traced for it: eye, reflected, refracted and shadow rays
  uint32_t hits = 0;   // surfaces hit by its camera, reflected and refracted rays
  uint32_t flags = 0;  // SampleFlag bits; 0 when nothing went wrong
  // The sample's rays by kind; 0 from an executor that does not count kinds (ExecutorOptions::ray_kinds).
  uint32_t reflected = 0;
  uint32_t refracted = 0;
  uint32_t total_reflections = 0;  // total reflections where a refracted ray would else be followed
  uint32_t trail = 1;              // a fingerprint of a random path's decisions (docs/gates.md); else 1
  bool cut_off = false;            // whether `max_depth` ended its path; for random paths only
  // The share of the background's light that comes straight to the eye, and is left out of a transparent
  // picture's `color`. 1 if the camera ray hits nothing; less behind a pane or through a medium.
  double background = 0;

  // The colour in front of a white background.
  Vec3 over_white() const { return color + background; }
};

// A denoiser's auxiliary values of one sample: those of the first vertex of its path that scatters light into
// more than a direction or two. The albedo of emitters, the sky included, is 1. The normal of the sky is 0.
struct AuxiliarySample {
  Vec3 albedo{0.0};
  Vec3 normal{0.0};  // world, unit, shading normal towards where the path comes from
  uint32_t flags = 0;
};

// Why a sample's colour may be incomplete. A flag is shown to the user and fails `verify`; it is never
// silent.
enum SampleFlag : uint32_t {
  media_overflow = 1u << 0,   // more than four media nested
  stack_overflow = 1u << 1,   // more rays pending than the shader's stack holds
  loop_budget = 1u << 2,      // the driver's cap on loop iterations was near (docs/lavapipe.md)
  iteration_limit = 1u << 3,  // an iterative search for a hit ended at its limit of steps
  endless = 1u << 4,  // a formula's loops did not end: readers of samples fail (executors/samples.hpp)
};

// The cost of one ray's search for its closest hit; −1 from an executor that does not count it.
struct SearchCost {
  int64_t nodes = -1;  // visited nodes of BVHs
  int64_t tests = -1;  // primitives tested
};

// The first hit of the camera ray through the centre of a pixel.
struct FirstHit {
  double t = std::numeric_limits<double>::infinity();  // infinity where nothing is hit
  Vec3 position{0.0};                                  // world
  Vec3 normal{0.0};                                    // world, unit, shading normal as the shape defines it
  Vec3 normal_geometric{0.0};  // world, unit, geometric normal as the shape defines it
  // The cosine between normal_geometric and the reversed ray's direction: above 0 the front is seen.
  double cosine = 0;
  Vec2 uv{0.0};
  int32_t primitive = -1;  // index, see Scene::primitive_count; −1 where nothing is hit
  int32_t material = -1;   // index in Scene::materials
  uint32_t flags = 0;      // SampleFlag bits; 0 when nothing went wrong
  // The largest coordinate that t was computed from, relative to the eye, divided by the cosine of incidence.
  // The rounding of coordinates shifts t in proportion to it. Only the reference sets it; else it is 0.
  double t_scale = 0;
  SearchCost cost{};  // cost of the search, with or without a hit: gates do not compare it
};

}  // namespace eyeray::engine
