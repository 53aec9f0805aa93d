#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/gpu/shader_source.hpp"

namespace eyeray::engine::gpu {

// The most errors, and the most warnings, of one text that are reported. Nobody reads more, and each costs a
// search in the text.
inline constexpr size_t most_messages = 20;
// The words that the last of these errors gets if so many more are left out.
std::string more_errors(size_t count);

// glslang's log (lines such as "ERROR: file:12: 'token' : message") as diagnostics, with the source lines of
// `source`. The column is that of the first quoted token that the line contains as a whole word. For a syntax
// error it is that of the unexpected sign, if the line has it once. An error in a row of a registry is
// reported at the row's file. At most `most_messages` of each severity.
std::vector<Diagnostic> parse_compiler_messages(std::string_view log, const ShaderSource& source);

}  // namespace eyeray::engine::gpu
