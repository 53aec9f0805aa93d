#include "host/render/flags.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace eyeray::engine::render {

std::span<const FlagText> flag_texts() {
  static constexpr FlagText texts[] = {
      {media_overflow, "media_overflow", "more than four media are nested: let fewer glass shapes overlap"},
      {stack_overflow, "stack_overflow",
       "more rays were pending than the shader keeps: lower render.max_depth or raise "
       "render.min_throughput"},
      {loop_budget, "loop_budget",
       "the driver's limit on loop iterations was near: lower render.max_depth or raise "
       "render.min_throughput; else show fewer shapes, or use the backend twin or a newer driver"},
      {iteration_limit, "iteration_limit",
       "the search for a shape ran out of steps; the AOV flags shows where"},
  };
  return texts;
}

std::string flag_warning(uint32_t flags, uint64_t pixels) {
  std::vector<std::string_view> reasons;
  for (const FlagText& each : flag_texts())
    if (flags & each.flag) reasons.push_back(each.text);
  if (reasons.empty()) return "";
  return fmt::format("{} pixel{} may be wrong: {}", pixels, pixels == 1 ? "" : "s", fmt::join(reasons, "; "));
}

}  // namespace eyeray::engine::render
