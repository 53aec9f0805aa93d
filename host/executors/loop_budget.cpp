#include "host/executors/loop_budget.hpp"

#include "host/core/error.hpp"
#include "host/core/option_text.hpp"

namespace eyeray::engine::executors {
namespace {

// A capped driver grants an invocation 65 535 iterations. eyeray relies on this many of them
// (docs/lavapipe.md).
constexpr uint64_t granted_iterations = 60000;

}  // namespace

uint64_t trace_iterations(const records::PackedScene& scene, bool unrolled) {
  return scene.has_bvh ? 0 : (unrolled ? 0 : scene.primitives.size()) + scene.shape_iterations;
}

uint32_t loop_budget_of(const records::PackedScene& scene, std::string_view driver) {
  // One ray with its shadow rays must fit after any earlier ones. In a BVH, a ray makes far fewer iterations
  // than there are primitives; if it does not, the shader detects that the driver stopped it.
  const uint64_t one_ray =
      (trace_iterations(scene, false) + 1) * (scene.lights.size() + 1 + (scene.panes ? MOST_PANES : 0));
  if (one_ray < granted_iterations) return uint32_t(granted_iterations - one_ray);
  throw Error(ExitCode::no_device,
              "{} silently ends loops after 65 535 iterations, too few for {} primitives{} and {} lights "
              "without a BVH: use a newer driver, or {}",
              driver, scene.primitives.size(),
              scene.shape_iterations > 0
                  ? fmt::format(" ({} iterations around their outlines)", scene.shape_iterations)
                  : "",
              scene.lights.size(), option_text("backend", "twin"));
}

void check_traced(uint32_t flags, std::string_view driver) {
  if (flags & FLAG_LOOP_BUDGET)
    throw Error(ExitCode::no_device,
                "{} ends loops after 65 535 iterations, before a ray was traced: use a newer driver, or {}",
                driver, option_text("backend", "twin"));
}

}  // namespace eyeray::engine::executors
