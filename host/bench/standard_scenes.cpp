#include "bench/standard_scenes.hpp"

#include <algorithm>

#include "generate/sphereflake.hpp"
#include "generate/terrain.hpp"
#include "loader/scene_file.hpp"

namespace eyeray {
namespace {

// A stage with a mesh of its last material on it.
Scene with_mesh(const std::string& stage, const char* name, MeshInMemory&& made) {
  Scene scene = parse_scene(stage, name);
  made.mesh.name = name;
  scene.meshes.push_back(std::move(made.mesh));
  scene.instances.push_back({.mesh = 0, .material = int(scene.materials.size()) - 1, .position = {}});
  return scene;
}

template <int grid>
Scene terrain() {
  MeshInMemory sink;
  terrain_mesh({.grid = grid}, sink);
  return with_mesh(terrain_stage(), "terrain", std::move(sink));
}

template <int size_factor>
std::string sphereflake_text() {
  return sphereflake_stage() + sphereflake_spheres(size_factor);
}

template <int size_factor>
Scene sphereflake() {
  return parse_scene(sphereflake_text<size_factor>(), "sphereflake");
}

Scene sphereflake_of_triangles() {
  MeshInMemory sink;
  sphereflake_mesh(4, sphereflake_divisions(4, 1'000'000), sink);
  return with_mesh(sphereflake_stage(), "sphereflake", std::move(sink));
}

constexpr StandardScene scenes[] = {
    {"terrain-51k", "terrain", terrain<160>, nullptr},
    {"terrain-1m", "terrain", terrain<707>, nullptr},
    {"terrain-8m", "terrain", terrain<2000>, nullptr},
    {"sphereflake-7k", "sphereflake", sphereflake<4>, sphereflake_text<4>},
    {"sphereflake-66k", "sphereflake", sphereflake<5>, sphereflake_text<5>},
    {"sphereflake-mesh", "sphereflake mesh", sphereflake_of_triangles, nullptr},
};

}  // namespace

std::span<const StandardScene> standard_scenes() {
  return scenes;
}

const StandardScene* find_standard_scene(std::string_view name) {
  const auto found = std::ranges::find(scenes, name, &StandardScene::name);
  return found == std::end(scenes) ? nullptr : &*found;
}

}  // namespace eyeray
