// Turns the TOML tree of a scene's files into a Scene. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/mesh_imports.hpp"
#include "host/reading/font_source.hpp"
#include "host/reading/formula_source.hpp"
#include "host/reading/image_source.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

// The sources of files that a scene names. A null source: the scene may name no such files.
struct SceneSources {
  reading::ImageSource* images = nullptr;
  MeshImports* meshes = nullptr;
  reading::FormulaSource* formulas = nullptr;
  reading::FontSource* fonts = nullptr;
};

// The scene without Scene::file, files and warnings. It is complete only if the log has no errors.
Scene build_scene(const toml::table& root, const SceneSources& sources, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
