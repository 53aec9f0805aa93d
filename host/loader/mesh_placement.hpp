// Puts instances of mesh files' contents into a scene. Private to the loader.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/importers/import.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

class MeshPlacer {
 public:
  explicit MeshPlacer(Scene& scene) : scene_(scene) {}

  struct Placing {
    Mat4 transform;
    std::optional<int> material;  // for all of it; absent: the file's own materials
    SourcePosition position;
    NameRef name;
  };

  // Adds all meshes that the file shows to `into`. The file's meshes move into the scene at the first call,
  // its materials when they are first needed. Returns the reason why the file cannot be shown under the
  // transform, or "".
  std::string place(importers::ImportedScene& import, const Placing& placing, std::vector<Instance>& into);
  // Likewise makes shapes of the file's points and lines, whose meshes must be in the scene. All points share
  // the file's data. The shapes stay here until they are taken.
  std::string place_shapes(const importers::ImportedScene& import, const Placing& placing);
  // Moves the shapes of that type, made so far, to the end of `into`.
  void take_shapes(std::string_view type, std::vector<std::unique_ptr<Shape>>& into);

  // The reason why a mesh of the scene cannot be shown under this map, or "".
  std::string check(size_t mesh, const Mat4& transform) const;

 private:
  // The indices in the scene of the first mesh and material of a file; −1 before they are added.
  struct Placed {
    int first_mesh = -1;
    int first_material = -1;
  };
  // The size of a mesh, by which check() decides whether a map is allowed.
  struct Extent {
    Bounds bounds;
    double thinnest;  // least thickness() of a triangle
  };

  void take_meshes(importers::ImportedScene& import, Placed& placed);
  void take_materials(importers::ImportedScene& import, Placed& placed);
  int plain_material_index(bool colored);
  int material_of(const importers::ImportedScene& import, const Placing& placing, int material, bool colored);

  Scene& scene_;
  std::map<const importers::ImportedScene*, Placed> placed_;
  std::vector<Extent> extents_;  // one a mesh of the scene
  std::vector<std::unique_ptr<Shape>> shapes_;
  int plain_[2] = {-1, -1};  // materials for meshes without one: without and with colours of their own
};

}  // namespace eyeray::engine::loader
