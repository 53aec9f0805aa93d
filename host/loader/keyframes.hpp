// Values between keyframes. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

#include "host/core/diagnostic_log.hpp"

namespace eyeray::engine::loader {

// The interpolation of a value from one keyframe to the next. It stays until then; it is linear; or it
// follows cubics whose slope at a keyframe is that between its neighbours (Catmull and Rom: A Class of Local
// Interpolating Splines, 1974), for frames that need not be evenly apart.
enum class Curve { step, linear, smooth };

// The value of a list of keyframes, [[frame, value], …], at `frame`, as TOML in one line: the first value
// before the first keyframe, the last one after the last. All values are of one form: numbers, lists and
// tables of them. Between two rotations { axis = …, degrees = … } about different axes it is the rotation on
// the shortest way (Shoemake: Animating Rotation with Quaternion Curves, SIGGRAPH 1985), whatever the curve
// except step. Empty after an error, which is in the log with its position.
std::optional<std::string> value_between(const toml::array& keyframes, double frame, Curve curve,
                                         DiagnosticLog& log);

}  // namespace eyeray::engine::loader
