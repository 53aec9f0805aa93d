// Makes the text of scene.glsl for one scene. With it, the entries compile only the scene's features.
#pragma once

#include <string>
#include <string_view>

#include "host/executors/profile.hpp"
#include "host/expression/loaded_numbers.hpp"
#include "host/pack/collapse.hpp"
#include "host/records/packer.hpp"

namespace eyeray::engine::executors {

struct Specialisation {
  bool constants = true;  // compile a small scene in, instead of loading it
  // The iterations that an invocation may make before it gives up with FLAG_LOOP_BUDGET
  // (executors/loop_budget.hpp); 0: no cap.
  uint32_t loop_budget = 0;
  Profile profile = {};
  uint32_t subgroup_size = 8;  // for kernels/cooperative/packet.comp.glsl
  pack::PacketBvh packet_bvh = {};
  uint32_t group_stride = 1;  // the runs into which kernels/render.comp.glsl deals out workgroups
  bool ray_kinds = false;     // count reflected and refracted rays
  bool search_cost = false;   // count the cost of searching for first hits
  // The numbers of formulas, for BINDING_FORMULA_NUMBERS; null: they go into the text.
  expression::LoadedNumbers* formula_numbers = nullptr;
};

std::string specialise(const records::PackedScene& scene, const Specialisation& options);

}  // namespace eyeray::engine::executors
