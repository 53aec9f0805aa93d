// From the tree of a scene's files to a Scene. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include "loader/mesh_imports.hpp"
#include "scene/diagnostic_log.hpp"
#include "scene/image_source.hpp"
#include "scene/scene.hpp"

namespace eyeray {

// Everything but Scene::file, files and warnings; only whole when the log has no errors. `images` and
// `meshes`: null where the scene may name no files.
Scene build_scene(const toml::table& root, ImageSource* images, MeshImports* meshes, DiagnosticLog& log);

}  // namespace eyeray
