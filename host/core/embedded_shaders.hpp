#pragma once

#include <span>

#include "host/core/embedded_file.hpp"

namespace eyeray::engine {

// Every file of shaders/, "shapes/sphere.glsl", as it was when eyeray was built.
std::span<const EmbeddedFile> embedded_shaders();

// The files that shaders need to be compiled as C++, beside the standard library: the program's own files,
// GLM's, and those that CMake writes. Names are paths below a folder that has them under "shaders".
std::span<const EmbeddedFile> twin_sources();

}  // namespace eyeray::engine
