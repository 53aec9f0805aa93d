// Triangles on a picture by the device's own rasteriser and z-buffer: the one graphics pipeline here.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "host/gpu/buffer.hpp"
#include "host/gpu/device.hpp"

namespace eyeray::engine::gpu {

// In Vulkan's clip space, w = 1: the picture reaches from −1 to 1, its top left first. What lies outside of
// it, or has a depth outside of 0 … 1, is clipped.
struct RasterVertex {
  float x = 0, y = 0;
  float depth = 0;  // the greater, the nearer; 0 is as far as undrawn pixels
  uint32_t id = 0;  // of the triangle's first vertex it counts
};

// Row by row.
struct RasterPicture {
  std::vector<uint32_t> ids;  // of the nearest triangle at the pixel's centre, of equally near ones the first
  std::vector<float> depths;  // its depth there; both 0 where there is none
};

// The shaders kernels/raster.vert.glsl and .frag.glsl as SPIR-V, whose entry points are "main".
struct RasterShaders {
  std::vector<uint32_t> vertex, fragment;
};

class Rasterizer {
 public:
  // `device` must be opened to draw (DeviceOptions::draws). Error (no_device) when it has no graphics queue,
  // and with the numbers when it draws no picture of that size, or has not that much memory.
  Rasterizer(Device& device, const RasterShaders& shaders, int width, int height);
  ~Rasterizer();
  Rasterizer(const Rasterizer&) = delete;
  Rasterizer& operator=(const Rasterizer&) = delete;

  // The best number of triangles to draw at once.
  static constexpr size_t batch = size_t{1} << 16;

  // Draws triangles, three vertices each, beside and behind those drawn before. Both sides are seen.
  void draw(std::span<const RasterVertex> vertices);
  RasterPicture read();

 private:
  struct Objects;  // Vulkan's

  std::shared_ptr<Context> context_;
  std::unique_ptr<Objects> objects_;
};

}  // namespace eyeray::engine::gpu
