// Scene files: TOML, strict. docs/scene-file.md is the manual, docs/scene.schema.json the schema for editors.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

// "render.max_depth=3", "image.width=64", "sphere.0.radius=2", "material.glass.ior=1.3",
// "light.1.intensity=[1,1,1]": a value that replaces the file's, as if it stood there. The right side is
// TOML; a bare word is taken as a string.
struct Override {
  std::string text;
  std::string written = {};  // the option as the user wrote it, "-s 640x480"; empty: "-D TEXT"
};

// The look of a mesh file alone. An override chooses it, "look=plain"; else it is `studio`, or `plain` if the
// overrides choose an integrator without random paths.
enum class MeshLook {
  plain,   // by whitted, in two lights
  studio,  // by path, in three area lights, on a floor that fades into the background
  clay,    // the same, all of clay
  sky      // by path, under a clear sky, on such a floor
};
inline constexpr std::string_view look_names[] = {"plain", "studio", "clay", "sky"};

// The permissions of a scene file.
struct Trust {
  std::vector<std::filesystem::path> folders =
      {};  // trees, beside its own folder's, from which it may read included files, images and meshes
  bool formulas = true;  // true: it may define functions; false: it may only use ready ones
};

// Reads a scene with its included files, applies the overrides, and checks it. A mesh file (.obj, .ply,
// .stl, .off, .3mf, .gltf, .glb), or one of points (.ply, .xyz, .pcd), becomes a scene that shows it. Throws
// InputError with all errors at once, or Error (file_io) if the file itself cannot be read, or (bad_input)
// for an unknown `look`.
Scene load_scene(const std::filesystem::path& file, std::span<const Override> overrides = {},
                 const Trust& trust = {});
// The mesh files of a scene in memory: the bytes of each file, by its name in the scene.
using MemoryFiles = std::map<std::string, std::string, std::less<>>;

// Parses a scene from memory. Messages contain `name`. The scene can neither include files nor name images,
// and can name only the meshes of `files`. `formulas`: as in Trust.
Scene parse_scene(std::string_view text, const std::string& name, std::span<const Override> overrides = {},
                  const MemoryFiles& files = {}, bool formulas = true);

// The JSON Schema of scene files, made from the Keys by which the loader checks them; docs/scene.schema.json.
std::string scene_schema();

// Every table and key of scene files as Markdown, made from the same Keys; docs/scene-reference.md.
std::string scene_manual();

}  // namespace eyeray::engine::loader
