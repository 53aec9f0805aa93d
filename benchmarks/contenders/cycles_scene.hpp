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
// Nothing biases the picture or ends paths except the scene's own depth, and the pixel filter is a box. At
// its end the script prints "eyeray: cpu SECONDS wall SECONDS", the times of rendering alone. Shapes become
// triangles: spheres and tori become many smooth ones, and planes become squares a hundred times as large as
// the scene. Error (bad_input) for everything that the script does not write or that Cycles shows
// differently: patterns, textures, rough materials, other shapes and cameras, groups, spots and lenses.
std::string cycles_scene(const Scene& scene, int width, int height);

// The picture of the environment that the script reads; empty if the scene has no environment.
std::optional<image::Image> cycles_environment(const Scene& scene);

}  // namespace eyeray::engine::contenders
