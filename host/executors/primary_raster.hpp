// What eye rays hit, by the device's own rasteriser: from there the rays of `--primary raster` start. At the
// edges of triangles the driver's grid, of 1/256 pixel or so, decides which of them is drawn, and beside
// curved shapes their tessellation; all else is as it is traced (docs/verification.md, gate R).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/gpu/buffer.hpp"
#include "host/gpu/rasterizer.hpp"
#include "host/records/packer.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::executors {

class PrimaryRaster {
 public:
  // Of a device that was opened to draw. Error (bad_input) where the scene's eye rays are not those of a
  // drawing: its camera is no projection, a shape cannot be drawn, or each pixel has its samples elsewhere;
  // (no_device) as gpu::Rasterizer.
  PrimaryRaster(gpu::Device& device, const Scene& scene, const records::PackedScene& packed);

  // Draws what lies where sample `index` does in each pixel, unless that was drawn last.
  void draw(uint32_t index);
  // That, row by row, as records.h says.
  gpu::Buffer& drawn() { return drawn_; }

 private:
  int width_, height_;
  uint32_t samples_per_side_;
  std::vector<gpu::RasterVertex> vertices_;
  gpu::Rasterizer rasterizer_;
  gpu::Buffer drawn_;
  std::optional<uint32_t> sample_;  // that was drawn last
};

}  // namespace eyeray::executors
