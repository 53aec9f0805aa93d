// Puts instanced groups, and their instances, into a scene. Private to the loader.
#pragma once

#include <vector>

#include "host/loader/mesh_placement.hpp"

namespace eyeray::engine::loader {

class GroupPlacer {
 public:
  GroupPlacer(Scene& scene, const MeshPlacer& meshes) : scene_(scene), meshes_(meshes) {}

  // Puts a group into the scene, and returns its index there. `stretch`: the worst condition number of the
  // maps from its members to its space.
  int keep(Group group, double stretch);

  // True if this transform surely keeps all shapes of the group valid. If false, each shape must be checked.
  bool surely_fits(int group, const Mat4& transform) const;
  // Adds an instance of the group.
  void place(int group, const Mat4& transform, const SourcePosition& position, const NameRef& name);

 private:
  Scene& scene_;
  const MeshPlacer& meshes_;
  struct Extent {
    Bounds bounds;     // bounds of the shapes
    double thickness;  // the least thickness_margin() of any shape
    double condition;  // the condition number of the worst map
  };
  std::vector<Extent> extents_;  // one for each of Scene::groups
};

}  // namespace eyeray::engine::loader
