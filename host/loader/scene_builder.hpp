// From the tree of a scene's files to a Scene. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include "scene/diagnostic_log.hpp"
#include "scene/image_source.hpp"
#include "scene/scene.hpp"

namespace eyeray {

// Everything but Scene::file, files and warnings; only whole when the log has no errors. `images`: null where
// the scene may name none.
Scene build_scene(const toml::table& root, ImageSource* images, DiagnosticLog& log);

}  // namespace eyeray
