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
  // On the pixels `area` of the scene's picture; the scene must outlive it. Error (bad_input) for a camera
  // that cannot be drawn.
  Projection(const Scene& scene, const Rect& area);
  Projection(const Projection&) = delete;
  Projection& operator=(const Projection&) = delete;

  const View& view() const { return view_; }
  const DrawList& list() const { return list_; }
  uint64_t triangles() const { return triangles_; }
  // View's nearness of a depth. The nearness of depth 0 is the one from which all others are measured.
  double nearness(float depth) const { return low_ + double(depth) * (high_ - low_); }

  // Calls visit(vertices, three a triangle) for Rasterizer::batch triangles at a time. Ids are the
  // primitives' and 1.
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
