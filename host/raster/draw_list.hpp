// The primitives of a scene that can be drawn, as triangles on a picture. Each traversal makes the triangles
// anew: those of a scene with many instances would not fit in memory.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "host/raster/view.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::raster {

class DrawList {
 public:
  // Scene and view must outlive the list.
  DrawList(const Scene& scene, const View& view);

  // Visits all triangles, in the order of their ids.
  void for_each(const std::function<void(const ScreenTriangle&)>& visit) const;

  // True if a primitive is drawn wherever it is seen.
  bool draws(uint64_t primitive) const;
  // The largest distance from the eye of the shape, or the mesh, of a primitive; 0 for planes.
  double reach(uint64_t primitive) const;
  // The numbers of primitives that are not drawn, by reason: "implicit", "with cutouts", "that blend".
  const std::map<std::string, uint64_t>& not_drawn() const { return not_drawn_; }

 private:
  using Visit = std::function<void(const ScreenTriangle&)>;

  void leave_out(const Shape& shape, uint64_t id);
  void leave_out(const Instance& instance, uint64_t id);
  void add(const Shape& shape, const Mat4& map, uint64_t id, const Visit& visit) const;
  void add(const Instance& instance, const Mat4& map, uint64_t id, const Visit& visit) const;
  // Calls shape(Shape, map, id) for each shape that the scene shows, and instance(Instance, map, id) for each
  // instance.
  template <typename OfShape, typename OfInstance>
  void walk(const OfShape& shape, const OfInstance& instance) const;

  const Scene& scene_;
  const View& view_;
  std::map<std::string, uint64_t> not_drawn_;
  std::map<uint64_t, uint64_t> left_out_;  // runs of ids that are not drawn: the first id, and the end
};

}  // namespace eyeray::engine::raster
