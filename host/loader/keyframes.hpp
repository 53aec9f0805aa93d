// Values between keyframes. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

#include "host/core/diagnostic_log.hpp"

namespace eyeray::engine::loader {

// How a value goes from one keyframe to the next: it stays until then; it goes straight; or by cubics whose
// slope at a keyframe is that between its neighbours (Catmull and Rom: A Class of Local Interpolating
// Splines, 1974), for frames that need not be evenly apart.
enum class Curve { step, linear, smooth };

// What a list of keyframes, [[frame, value], …], holds at `frame`, as TOML in one line: before the first of
// them the first value, after the last the last. All values are of one form: numbers, lists and tables of
// them. Of two rotations { axis = …, degrees = … } about different axes it is that on the shortest way
// between them (Shoemake: Animating Rotation with Quaternion Curves, SIGGRAPH 1985), whatever the curve but
// step. Nothing after an error, which is in the log with its place.
std::optional<std::string> value_between(const toml::array& keyframes, double frame, Curve curve,
                                         DiagnosticLog& log);

}  // namespace eyeray::engine::loader
