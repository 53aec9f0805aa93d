// Groups that are kept once, and their instances, put into a scene. Private to the loader.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "loader/mesh_placement.hpp"

namespace eyeray {

class GroupPlacer {
 public:
  GroupPlacer(Scene& scene, const MeshPlacer& meshes) : scene_(scene), meshes_(meshes) {}

  // Takes a group into the scene; its index there.
  int keep(Group group);

  // Whether shapes in it may forbid the map, as a sphere forbids one that stretches. Asked once a group, of
  // the first such map: they allow all or none.
  bool is_to_be_tried(int group, const Mat4& transform);

  // Shows the group once more. Why it cannot stand there, or "".
  std::string place(int group, const Mat4& transform, const SourcePosition& position, const NameRef& name);

 private:
  struct Kept {
    Bounds bounds;  // of its shapes
    bool tried = false;
  };

  Scene& scene_;
  const MeshPlacer& meshes_;
  std::vector<Kept> kept_;  // as Scene::groups
};

}  // namespace eyeray
