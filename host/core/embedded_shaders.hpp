#pragma once

#include <span>
#include <string_view>

namespace eyeray {

struct EmbeddedShader {
  std::string_view name;  // its path below shaders/, "shapes/sphere.glsl"
  std::string_view text;
};

// Every file of shaders/, as it was when eyeray was built.
std::span<const EmbeddedShader> embedded_shaders();

// What they need to be compiled as C++, beside the standard library: the program's own files, GLM's, and what
// CMake writes. Names are paths below a folder that has them under "shaders".
std::span<const EmbeddedShader> twin_sources();

}  // namespace eyeray
