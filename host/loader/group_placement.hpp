// Instanced groups, and their instances, put into a scene. Private to the loader.
#pragma once

#include <vector>

#include "host/loader/mesh_placement.hpp"

namespace eyeray::engine::loader {

class GroupPlacer {
 public:
  GroupPlacer(Scene& scene, const MeshPlacer& meshes) : scene_(scene), meshes_(meshes) {}

  // Takes a group into the scene; its index there. `stretch`: the worst condition of the maps
  // from its members to its space.
  int keep(Group group, double stretch);

  // True if all shapes of the group can surely stand there. If not, each must be checked.
  bool surely_fits(int group, const Mat4& transform) const;
  // Shows the group once more.
  void place(int group, const Mat4& transform, const SourcePosition& position, const NameRef& name);

 private:
  Scene& scene_;
  const MeshPlacer& meshes_;
  struct Extent {
    Bounds bounds;     // of the shapes
    double thickness;  // the least margin of any shape
    double condition;  // of the worst map
  };
  std::vector<Extent> extents_;  // as Scene::groups
};

}  // namespace eyeray::engine::loader
