// The primitive indices of a scene, which are the same in every executor and decide exact ties. Shapes come
// first, with the shapes of a group where the group stands. The triangles of meshes follow in the same
// manner. They do not depend on which groups are instanced.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace eyeray::engine {

struct Scene;

class PrimitiveIds {
 public:
  // The ids of the scene as it is now.
  explicit PrimitiveIds(const Scene& scene);

  // The id of an element of Scene::shapes, and the id of the first triangle of one of Scene::instances.
  uint64_t of_shape(size_t shape) const;
  uint64_t of_instance(size_t instance) const { return instances_[instance]; }

  // The ids of a group instance's first shape and first triangle. The others follow in the group's order.
  struct First {
    uint64_t shape = 0;
    uint64_t triangle = 0;
  };
  First of_group(size_t group_instance) const { return groups_[group_instance]; }

  uint64_t count() const { return count_; }

  // The location of a primitive: it is a shape or a triangle of an instance, either the scene's own or in the
  // group that a group instance shows.
  struct Location {
    int group_instance = -1;  // −1: the scene's own
    bool is_shape = true;
    size_t index = 0;     // index of the shape, or of the instance of a mesh
    size_t triangle = 0;  // triangle of the instance's mesh
  };
  Location locate(uint64_t primitive, const Scene& scene) const;

 private:
  std::vector<size_t> shapes_before_;   // GroupInstance::shapes_before, ascending
  std::vector<uint64_t> group_shapes_;  // shapes in the group instances before each; one more at the end
  std::vector<uint64_t> instances_;
  std::vector<First> groups_;
  uint64_t shape_count_ = 0;
  uint64_t count_ = 0;
};

}  // namespace eyeray::engine
