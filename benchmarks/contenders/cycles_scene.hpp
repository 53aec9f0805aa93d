#pragma once

#include <optional>
#include <string>

#include "host/image/image.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::contenders {

// The name under which Blender looks for the environment, in the folder of its script.
inline constexpr std::string_view cycles_environment_file = "environment.exr";

// The scene as a Python script for Blender 3.4, which renders it by Cycles:
//   blender -b --factory-startup -P SCRIPT -- OUTPUT.exr SAMPLES SEED
// Only the scene's own depth biases it or cuts paths off, and a pixel is a box. At its end it prints
// "eyeray: cpu SECONDS wall SECONDS", of rendering alone. Shapes become triangles: spheres and tori many of
// them, smooth, and planes squares of a hundred times the scene. Error (bad_input) for things without a
// likeness there, or with one that differs: patterns, textures, rough materials, other shapes and cameras,
// groups, spots and lenses.
std::string cycles_scene(const Scene& scene, int width, int height);

// The script's picture of the environment; empty if there is none.
std::optional<image::Image> cycles_environment(const Scene& scene);

}  // namespace eyeray::engine::contenders
