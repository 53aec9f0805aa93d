// Rasterised visibility as a witness of camera rays: forward mapping against inverse mapping. A scene's
// triangles are drawn once, and executors' first hits are compared with them (docs/gates.md, gate R).
#pragma once

#include <string>
#include <vector>

#include "host/compare/frame.hpp"
#include "host/compare/raster_result.hpp"
#include "host/gpu/device.hpp"
#include "host/gpu/rasterizer.hpp"
#include "host/raster/judge.hpp"
#include "host/raster/possible.hpp"
#include "host/raster/projection.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::raster {

class Witness {
 public:
  // Draws the pixels `area` of the scene, which must outlive it. Error (bad_input) for a camera that cannot
  // be drawn, (no_device) where the device has no graphics queue or not enough memory, or if the validation
  // layer reported a fault.
  Witness(const Scene& scene, const Rect& area, gpu::DeviceOptions options);
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;

  // Compares the first hits of an executor called `name`.
  compare::RasterResult compare(const compare::Frame& frame, const std::string& name) const;

 private:
  const View& view() const { return projection_.view(); }
  const DrawList& list() const { return projection_.list(); }
  Seen drawn_at(size_t pixel) const;
  Seen traced_at(const compare::Frame& frame, size_t pixel) const;
  std::string misplaced(const FirstHit& hit, int x, int y) const;
  // For each of `pixels`, in ascending order, the triangles that may be within their slack of the pixel's
  // centre.
  std::vector<std::vector<ScreenTriangle>> triangles_about(const std::vector<size_t>& pixels) const;

  const Scene& scene_;
  Projection projection_;
  gpu::RasterPicture picture_;  // an id is the primitive's id plus 1
  std::string device_;
  Exactness exactness_;
};

}  // namespace eyeray::engine::raster
