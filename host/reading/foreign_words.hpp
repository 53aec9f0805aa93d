// Other renderers' words for the things of a scene file, for "did you mean".
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace eyeray::engine::reading {

// The one of `names` that was most likely meant by `word`. That is one that POV-Ray, pbrt, Mitsuba or Blender
// call so; else one of which `word` may be a typing error (nearest_name); "" when there is none.
std::string suggest_name(std::string_view word, std::span<const std::string_view> names);

}  // namespace eyeray::engine::reading
