#pragma once

#include <string_view>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/gpu/shader_source.hpp"

namespace eyeray::engine::gpu {

// glslang's log (lines such as "ERROR: file:12: 'token' : message") as diagnostics, with the source lines of
// `source`. The column is that of the first quoted token that the line contains as a whole word. For a syntax
// error it is that of the unexpected sign, if the line has it once. An error in a row of a registry is
// reported at the row's file. Only the first 20 errors and the first 20 warnings are reported.
std::vector<Diagnostic> parse_compiler_messages(std::string_view log, const ShaderSource& source);

}  // namespace eyeray::engine::gpu
