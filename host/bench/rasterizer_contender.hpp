// The device's own rasteriser as a contender on eye rays: what it draws at the centre of a pixel is what such
// a ray hits.
#pragma once

#include <vector>

#include "host/bench/field.hpp"
#include "host/gpu/rasterizer.hpp"
#include "host/raster/projection.hpp"

namespace eyeray::bench {

class RasterizerContender {
 public:
  // The scene must outlive it; its picture's size is that of the primary_batch that it is asked about. Error
  // (bad_input) for a camera or a shape that cannot be drawn, (no_device) as gpu::Rasterizer.
  RasterizerContender(const Scene& scene, const std::string& device);

  Contender contender();
  // Its triangles, projected in float64 on the host; tracing and drawing have that behind them.
  const Build& build() const { return build_; }

 private:
  double draw(const Batch& batch, std::span<QueryHit> hits);

  raster::Projection projection_;
  gpu::Device device_;
  gpu::Rasterizer rasterizer_;
  std::vector<gpu::RasterVertex> vertices_;
  Build build_;
};

}  // namespace eyeray::bench
