// Groups that are kept once, and their instances, put into a scene. Private to the loader.
#pragma once

#include <string>
#include <vector>

#include "loader/mesh_placement.hpp"

namespace eyeray {

class GroupPlacer {
 public:
  GroupPlacer(Scene& scene, const MeshPlacer& meshes) : scene_(scene), meshes_(meshes) {}

  // Takes a group into the scene; its index there.
  int keep(Group group);

  // Shows the group once more. Why it cannot stand there, or "".
  std::string place(int group, const Mat4& transform, const SourcePosition& position, const NameRef& name);

 private:
  Scene& scene_;
  const MeshPlacer& meshes_;
  std::vector<Bounds> bounds_;  // of each group's shapes, as Scene::groups
};

}  // namespace eyeray
