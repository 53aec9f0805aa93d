#pragma once

#include <string_view>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/gpu/shader_source.hpp"

namespace eyeray::engine::gpu {

// glslang's log ("ERROR: file:12: 'token' : message" a line) as diagnostics, with the source lines of
// `source`. The column is that of the first token quoted that the line contains as a whole word, or of
// the sign that a syntax error is at, where the line has it once. An error in a row of a registry is reported
// at the row's file.
std::vector<Diagnostic> parse_compiler_messages(std::string_view log, const ShaderSource& source);

}  // namespace eyeray::engine::gpu
