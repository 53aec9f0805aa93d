// Instances of mesh files' contents, put into a scene. Private to the loader.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/importers/import.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

class MeshPlacer {
 public:
  explicit MeshPlacer(Scene& scene) : scene_(scene) {}

  // Adds everything that the file shows to `into`, moved by `transform`, with one material for all or,
  // absent, with the file's own. The first time, the file's meshes, and its materials once they are needed,
  // move into the scene. Why it cannot stand there, or "".
  std::string place(importers::ImportedScene& import, const Mat4& transform, std::optional<int> material,
                    const SourcePosition& position, const NameRef& name, std::vector<Instance>& into);

  // Why a mesh of the scene cannot stand under this map, or "".
  std::string check(size_t mesh, const Mat4& transform) const;

 private:
  // The indices in the scene of the first mesh and material of a file; −1 before they are added.
  struct Place {
    int first_mesh = -1;
    int first_material = -1;
  };
  // The facts that decide whether a map leaves a mesh sound.
  struct Extent {
    Bounds bounds;
    double thinnest;  // triangle, see thickness()
  };

  void take_meshes(importers::ImportedScene& import, Place& place);
  void take_materials(importers::ImportedScene& import, Place& place);
  int plain_material_index(const Mesh& mesh);

  Scene& scene_;
  std::map<const importers::ImportedScene*, Place> places_;
  std::vector<Extent> extents_;  // one a mesh of the scene
  int plain_[2] = {-1, -1};  // the materials of meshes that have none: without and with colours of vertices
};

}  // namespace eyeray::engine::loader
