// What primitive indices stand for: which shape, or which triangle of which mesh, by the words of the file.
#pragma once

#include "scene/scene.hpp"

namespace eyeray {

// A shape of the scene, or an instance of a mesh.
struct Thing {
  std::string_view kind;  // "sphere", "mesh"
  NameRef name;
  std::string_view mesh;  // what its file calls the mesh; "" of shapes
  const SourcePosition* position;
  int material;
  uint64_t first;  // primitive index
  uint64_t count;  // of primitives: 1, or the mesh's triangles
};

class Things {
 public:
  // `scene` must outlive it.
  explicit Things(const Scene& scene);

  // The shapes, then the instances.
  size_t size() const { return scene_.shapes.size() + ends_.size(); }
  Thing operator[](size_t index) const;
  // The thing that a primitive belongs to; primitive < Scene::primitive_count().
  size_t of(uint64_t primitive) const;

  // `sphere "left eye", scene.toml:12`, and of a mesh `triangle 7 of mesh "mug", scene.toml:40`.
  std::string describe(uint64_t primitive) const;

 private:
  const Scene& scene_;
  std::vector<uint64_t> ends_;  // of the instances' primitive indices
};

}  // namespace eyeray
