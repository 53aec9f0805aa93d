// The objects that primitive indices stand for: a shape, or a triangle of a mesh, named as in the file.
#pragma once

#include "host/scene/primitive_ids.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine {

// A shape or an instance of a mesh: one of the scene's own, or one that a group instance shows.
struct Object {
  std::string_view kind;  // "sphere", "mesh"
  NameRef name;
  NameRef group;          // name of the group instance; goes before `name`
  std::string_view mesh;  // the mesh's name in its file; "" for shapes
  const SourcePosition* position;
  int material;
  uint64_t first;  // index of the first primitive
  uint64_t count;  // number of primitives: 1, or the mesh's triangles
};

class Objects {
 public:
  // `scene` must outlive it.
  explicit Objects(const Scene& scene);

  // The scene's own shapes and instances, then those of each group instance.
  size_t size() const { return first_in_group_.back(); }
  Object operator[](size_t index) const;
  // The object that a primitive belongs to; primitive < Scene::primitive_count().
  size_t of(uint64_t primitive) const;

  // `sphere "left eye", scene.toml:12`, and of a mesh `triangle 7 of mesh "mug", scene.toml:40`.
  std::string describe(uint64_t primitive) const;

 private:
  const Scene& scene_;
  PrimitiveIds ids_;
  std::vector<size_t> first_in_group_;  // index of each group instance's first object; one more at the end
};

// The names of the object's groups, then its own name; "" if there are none.
std::string path(const Object& object, const Names& names);
// Describes an object, like describe() of a name.
std::string describe(const Object& object, const Names& names);

}  // namespace eyeray::engine
