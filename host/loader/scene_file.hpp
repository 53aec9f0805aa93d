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
// "light.1.intensity=[1,1,1]": a value laid over the file, the same as if it stood there. The right side is
// TOML; a bare word is taken as a string.
struct Override {
  std::string text;
  std::string written = {};  // as its author did: "-s 640x480"; empty: "-D TEXT"
};

// The rights of a scene file.
struct Trust {
  std::vector<std::filesystem::path> folders =
      {};  // beside its own that it may read included files, images and meshes from, with all below
  bool formulas = true;  // whether it may define functions, or use ready ones alone
};

// Reads, includes, overrides and checks a scene, or makes one that shows a mesh file (.obj, .ply, .gltf,
// .glb). Throws InputError with every error at once, or Error (file_io) when the file itself
// cannot be read.
Scene load_scene(const std::filesystem::path& file, std::span<const Override> overrides = {},
                 const Trust& trust = {});
// The mesh files of a scene that is in no file: the bytes of each, by the name that the scene gives.
using MemoryFiles = std::map<std::string, std::string, std::less<>>;

// Parses a scene from memory. `name` stands in messages. The scene can neither include files nor name images,
// and can name only the meshes of `files`. `formulas`: as in Trust.
Scene parse_scene(std::string_view text, const std::string& name, std::span<const Override> overrides = {},
                  const MemoryFiles& files = {}, bool formulas = true);

// The JSON Schema of scene files, made from the same Keys that the loader checks by; docs/scene.schema.json.
std::string scene_schema();

// Every table and key of scene files as Markdown, made from the same Keys; docs/scene-reference.md.
std::string scene_manual();

}  // namespace eyeray::engine::loader
