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

}  // namespace eyeray
