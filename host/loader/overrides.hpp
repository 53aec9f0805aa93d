// Overrides (-D): values that replace those of the scene's files. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/scene_file.hpp"

namespace eyeray::engine::loader {

// The whole number that is all of the text, or nothing.
std::optional<size_t> as_index(std::string_view text);

// The override as the user wrote it, for messages.
std::string as_written(const Override& change);

// Sets each value at its key in the tree, as if it stood in the file. All values are checked later.
void apply_overrides(toml::table& root, std::span<const Override> overrides, DiagnosticLog& log);

// Sets a value in TOML that was interpolated from keyframes. `at`: the position of `target`, the key.
// `value_at`: the position of its keyframes, at which errors in the value are reported. Returns the parts of
// the key, with indices in place of names: "sphere", "0", "radius". After an error there are none.
std::vector<std::string> apply_track(toml::table& root, std::string_view target, std::string_view value,
                                     const SourcePosition& at, const SourcePosition& value_at,
                                     DiagnosticLog& log);

}  // namespace eyeray::engine::loader
