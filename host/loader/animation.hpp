// The animation of a scene: tracks of keyframes, whose values at one frame replace the scene's. Private to
// the loader.
#pragma once

#include <toml++/toml.h>

#include <span>

#include "host/core/diagnostic_log.hpp"
#include "host/reading/table_reader.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

std::span<const reading::Key> animation_keys();
std::span<const reading::Key> track_keys();
extern const std::string_view track_manual;

// Takes [animation] and every [[track]] out of the tree. Sets each track's target, as -D does, to its value
// at the frame shown. Returns the parts that the scene keeps. Faults go to the log; those of a value are
// reported at its keyframes.
Animation apply_animation(toml::table& root, DiagnosticLog& log);

// The moment that the picture shows, in seconds.
double seconds(const Animation& animation);
// Counts values that move, from the frame `first` to the frame `last`.
void add_moving(int values, double first, double last, Animation& animation);

}  // namespace eyeray::engine::loader
