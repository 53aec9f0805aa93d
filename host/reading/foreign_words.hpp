// Other renderers' words for the tables, keys and values of a scene file, for "did you mean".
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace eyeray::engine::reading {

// The one of `names` that `word` most likely means. It is the name for which POV-Ray, pbrt, Mitsuba or
// Blender have `word`. Else it is a name of which `word` may be a typing error (nearest_name), or "".
std::string suggest_name(std::string_view word, std::span<const std::string_view> names);

// What to write where `word` is none of the choices of a value, and means something that is written in
// another way; or "".
std::string_view advice_on(std::string_view word, std::span<const std::string_view> choices);

}  // namespace eyeray::engine::reading
