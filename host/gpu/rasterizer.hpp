// Draws triangles by the device's own rasteriser and z-buffer. This is the only graphics pipeline here.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "host/gpu/buffer.hpp"
#include "host/gpu/device.hpp"

namespace eyeray::engine::gpu {

// A vertex in Vulkan's clip space, with w = 1. The picture reaches from −1 to 1, from the top left. Anything
// outside of it, or with a depth outside of 0 … 1, is clipped.
struct RasterVertex {
  float x = 0, y = 0;
  float depth = 0;  // the greater, the nearer; 0 is as far as undrawn pixels
  uint32_t id = 0;  // a triangle has the id of its first vertex
};

// A drawn picture, row by row.
struct RasterPicture {
  std::vector<uint32_t> ids;  // ids of the nearest triangle at the pixel's centre; of a tie, the first
  std::vector<float> depths;  // that triangle's depth there; id and depth are 0 if there is no triangle
};

// The shaders kernels/raster.vert.glsl and .frag.glsl as SPIR-V, whose entry points are "main".
struct RasterShaders {
  std::vector<uint32_t> vertex, fragment;
};

class Rasterizer {
 public:
  // `device` must be opened to draw (DeviceOptions::draws). Error (no_device) when the device has no graphics
  // queue, and with the numbers when it draws no picture of that size, or has too little memory.
  Rasterizer(Device& device, const RasterShaders& shaders, int width, int height);
  ~Rasterizer();
  Rasterizer(const Rasterizer&) = delete;
  Rasterizer& operator=(const Rasterizer&) = delete;

  // The best number of triangles to draw at once.
  static constexpr size_t batch = size_t{1} << 16;

  // Draws triangles, of three vertices each, together with those drawn before: the nearest stays. Both sides
  // of a triangle are seen.
  void draw(std::span<const RasterVertex> vertices);
  RasterPicture read();

 private:
  struct Objects;  // Vulkan's objects
  struct Draw {
    size_t vertices = 0;
    int64_t cost = 0;
  };

  Draw next_draw(std::span<const RasterVertex> vertices) const;

  std::shared_ptr<Context> context_;
  std::unique_ptr<Objects> objects_;
};

}  // namespace eyeray::engine::gpu
