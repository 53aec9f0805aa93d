// A scene's triangles as a rasteriser takes them: on a picture, with depths of 0 to 1.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "host/gpu/rasterizer.hpp"
#include "host/raster/draw_list.hpp"
#include "host/raster/view.hpp"

namespace eyeray::engine::raster {

class Projection {
 public:
  // Projects the scene onto the pixels `area` of its picture; the scene must outlive the projection. Error
  // (bad_input) for a camera that cannot be drawn.
  Projection(const Scene& scene, const Rect& area);
  Projection(const Projection&) = delete;
  Projection& operator=(const Projection&) = delete;

  const View& view() const { return view_; }
  const DrawList& list() const { return list_; }
  uint64_t triangles() const { return triangles_; }
  // The nearness, as in View, of a depth. Depths are measured from the nearness of depth 0.
  double nearness(float depth) const { return low_ + double(depth) * (high_ - low_); }

  // Calls visit with the vertices, three for each triangle, of Rasterizer::batch triangles at a time. An id
  // is the primitive's id plus 1.
  void for_each_batch(const std::function<void(std::span<const gpu::RasterVertex>)>& visit) const;

 private:
  View view_;
  DrawList list_;
  uint64_t triangles_ = 0;
  double low_ = 0, high_ = 1;  // the nearness of depths 0 and 1
};

// The shaders that draw the triangles, as SPIR-V.
gpu::RasterShaders raster_shaders();

}  // namespace eyeray::engine::raster
