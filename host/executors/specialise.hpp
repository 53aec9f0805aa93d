// Made for one scene: the text of scene.glsl, with which the entries compile only what the scene has.
#pragma once

#include <string>
#include <string_view>

#include "host/executors/profile.hpp"
#include "host/pack/collapse.hpp"
#include "host/records/packer.hpp"

namespace eyeray::executors {

struct Specialisation {
  bool constants = true;  // compile a small scene in, instead of loading it
  uint32_t loop_budget =
      0;  // iterations an invocation may make before it gives up with FLAG_LOOP_BUDGET; 0: no cap
  Profile profile = {};
  uint32_t subgroup_size = 8;  // of kernels/cooperative/packet.comp.glsl
  pack::PacketBvh packet_bvh = {};
  uint32_t group_stride = 1;  // kernels/render.comp.glsl: runs of workgroups
  bool ray_kinds = false;     // count reflected and refracted rays
  bool search_cost = false;   // of first hits
};

// How often a path may go on: 0 where no material sends rays on, or the integrator none.
uint32_t most_bounces(const records::PackedScene& scene);
bool casts_shadow_rays(const records::PackedScene& scene);  // the scene's integrator

// How many loop iterations a ray takes at most through what is in no BVH. Through a BVH it takes far fewer
// than there are primitives, nobody knows how many.
uint64_t trace_iterations(const records::PackedScene& scene, bool unrolled);

// Specialisation::loop_budget where the driver ends loops and says nothing (docs/lavapipe.md). Error
// (no_device), which names it, where one ray may need more than it grants.
uint32_t loop_budget_of(const records::PackedScene& scene, std::string_view driver);

std::string specialise(const records::PackedScene& scene, const Specialisation& options);

}  // namespace eyeray::executors
