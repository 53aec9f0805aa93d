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
// Nothing in it is biased or cut off but by the scene's own depth, and a pixel is a box. At its end it prints
// "eyeray: cpu SECONDS wall SECONDS", of rendering alone. Shapes become triangles: spheres and tori many of
// them, smooth, and planes squares of a hundred times the scene. Error (bad_input) for what has no likeness
// there, or one that is not the same: patterns, textures, rough materials, other shapes and cameras, groups,
// spots and lenses.
std::string cycles_scene(const Scene& scene, int width, int height);

// The script's picture of the environment; empty if there is none.
std::optional<image::Image> cycles_environment(const Scene& scene);

}  // namespace eyeray::engine::contenders
