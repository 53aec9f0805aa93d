// Interpolates values between keyframes. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

#include "host/core/diagnostic_log.hpp"

namespace eyeray::engine::loader {

// The interpolation of a value from one keyframe to the next. `step`: the value stays until the next
// keyframe. `smooth`: cubics whose slope at a keyframe is that between its neighbours (Catmull and Rom: A
// Class of Local Interpolating Splines, 1974), for frames that need not be evenly spaced.
enum class Curve { step, linear, smooth };

// The value of a list of keyframes, [[frame, value], …], at `frame`, as TOML in one line: the first value
// before the first keyframe, the last value after the last keyframe. All values are of one form: numbers,
// lists and tables of them. Two rotations { axis = …, degrees = … } about different axes are interpolated on
// the shortest way (Shoemake: Animating Rotation with Quaternion Curves, SIGGRAPH 1985), for every curve
// except step. Empty after an error, which is in the log with its position.
std::optional<std::string> value_between(const toml::array& keyframes, double frame, Curve curve,
                                         DiagnosticLog& log);

}  // namespace eyeray::engine::loader
