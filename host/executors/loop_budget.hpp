// Limits on loop iterations, for drivers that silently end long loops (docs/lavapipe.md).
#pragma once

#include <cstdint>
#include <string_view>

#include "host/records/packer.hpp"

namespace eyeray::engine::executors {

// The largest number of loop iterations of a ray through the primitives that are in no BVH. In a BVH, a ray
// makes an unknown number of iterations, far fewer than there are primitives.
uint64_t trace_iterations(const records::PackedScene& scene, bool unrolled);

// Specialisation::loop_budget for a driver that ends long loops. Error (no_device), which names the driver,
// if one ray may need more iterations than it grants.
uint32_t loop_budget_of(const records::PackedScene& scene, std::string_view driver);

// Error (no_device), which names the driver, if the flags of a ray show that the driver ended loops
// nevertheless.
void check_traced(uint32_t flags, std::string_view driver);

}  // namespace eyeray::engine::executors
