#include "benchmarks/bench/standard_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/atomic_file.hpp"
#include "host/generate/ply_file.hpp"
#include "host/generate/sphereflake.hpp"
#include "host/generate/terrain.hpp"
#include "host/loader/scene_file.hpp"

namespace eyeray::engine::bench {

namespace fs = std::filesystem;

namespace {

// The scene of the text `stage`, with the mesh `made` of the scene's last material.
Scene with_mesh(const std::string& stage, const char* name, generate::MeshInMemory&& made) {
  Scene scene = loader::parse_scene(stage, name);
  made.mesh.name = name;
  scene.meshes.push_back(std::move(made.mesh));
  scene.instances.push_back({.mesh = 0, .material = int(scene.materials.size()) - 1, .position = {}});
  return scene;
}

// Writes the scene file, and the mesh beside it as a .ply.
template <typename Make>
void write_with_mesh(const fs::path& file, const std::string& stage, const char* material, const Make& make) {
  const fs::path mesh = fs::path(file).replace_extension(".ply");
  generate::PlyFile sink(mesh, "eyeray-bench");
  make(sink);
  sink.commit();
  write_file_atomically(file, stage + fmt::format("\n[[mesh]]\nfile = \"{}\"\nmaterial = \"{}\"\n",
                                                  mesh.filename().string(), material));
}

template <int grid>
Scene terrain() {
  generate::MeshInMemory sink;
  generate::terrain_mesh({.grid = grid}, sink);
  return with_mesh(generate::terrain_stage(), "terrain", std::move(sink));
}

template <int grid>
void write_terrain(const fs::path& file) {
  write_with_mesh(file, generate::terrain_stage(), "ground",
                  [](generate::MeshSink& sink) { generate::terrain_mesh({.grid = grid}, sink); });
}

template <int size_factor>
std::string sphereflake_text() {
  return generate::sphereflake_stage() + generate::sphereflake_spheres(size_factor);
}

template <int size_factor>
Scene sphereflake() {
  return loader::parse_scene(sphereflake_text<size_factor>(), "sphereflake");
}

template <int size_factor>
void write_sphereflake(const fs::path& file) {
  write_file_atomically(file, sphereflake_text<size_factor>());
}

void tessellate_sphereflake(generate::MeshSink& sink) {
  generate::sphereflake_mesh(4, generate::sphereflake_divisions(4, 1'000'000), sink);
}

Scene sphereflake_of_triangles() {
  generate::MeshInMemory sink;
  tessellate_sphereflake(sink);
  return with_mesh(generate::sphereflake_stage(), "sphereflake", std::move(sink));
}

void write_sphereflake_of_triangles(const fs::path& file) {
  write_with_mesh(file, generate::sphereflake_stage(), "ball", tessellate_sphereflake);
}

constexpr StandardScene scenes[] = {
    {"terrain-51k", "terrain", terrain<160>, write_terrain<160>},
    {"terrain-1m", "terrain", terrain<707>, write_terrain<707>},
    {"terrain-8m", "terrain", terrain<2000>, write_terrain<2000>},
    {"sphereflake-7k", "sphereflake", sphereflake<4>, write_sphereflake<4>},
    {"sphereflake-66k", "sphereflake", sphereflake<5>, write_sphereflake<5>},
    {"sphereflake-mesh", "sphereflake mesh", sphereflake_of_triangles, write_sphereflake_of_triangles},
};

}  // namespace

std::span<const StandardScene> standard_scenes() {
  return scenes;
}

const StandardScene* find_standard_scene(std::string_view name) {
  const auto found = std::ranges::find(scenes, name, &StandardScene::name);
  return found == std::end(scenes) ? nullptr : &*found;
}

}  // namespace eyeray::engine::bench
