// Instanced groups, and their instances.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/core/vec.hpp"
#include "host/scene/mesh.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine {

// Shapes and meshes in the group's object space. Each is bounded, and belongs to one group only.
struct Group {
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<Instance> instances;  // their transforms lead into the group's space
};

// A group in the world. Under a transform that mirrors, the outside stays outside.
struct GroupInstance {
  int group = 0;        // index in Scene::groups
  Mat4 transform{1.0};  // group to world: affine and invertible
  // The numbers of Scene::shapes and of Scene::instances before the group: its position if it were not
  // instanced.
  size_t shapes_before = 0;
  size_t instances_before = 0;
  SourcePosition position;
  NameRef name = {};  // in Scene::names; goes before those of its members
};

// The bounds and the counts of a group. `meshes`: those of the scene.
Bounds bounds(const Group& group, const std::vector<Mesh>& meshes);
uint64_t count_triangles(const Group& group, const std::vector<Mesh>& meshes);
uint64_t count_primitives(const Group& group, const std::vector<Mesh>& meshes);

}  // namespace eyeray::engine
