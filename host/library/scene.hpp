// The implementation of the library's scenes.
#pragma once

#include <eyeray/eyeray.hpp>

#include <string>
#include <string_view>
#include <vector>

#include "host/loader/scene_file.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::inline v0 {

struct Scene::Data {
  engine::Scene scene;
  std::vector<Diagnostic> warnings;

  // Checks a scene that has been read, as the program checks it.
  static Scene checked(engine::Scene scene);
};

}  // namespace eyeray::inline v0

namespace eyeray::engine::library {

// Throws the same v0::Error as v0::Scene::parse.
v0::Scene parse(std::string_view toml, std::string_view name, const v0::SceneOptions& options,
                const loader::MemoryFiles& files);

}  // namespace eyeray::engine::library
