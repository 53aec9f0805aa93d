// An image of one level: texels that a kernel reads and writes by their coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "host/gpu/device.hpp"
#include "host/gpu/texel_format.hpp"

namespace eyeray::engine::gpu {

class RawBuffer;

// An image's format must be set.
struct ImageShape {
  ReflectedImage declared{};
  std::array<uint32_t, 3> extent{1, 1, 1};  // texels; the layers of an array come after its other axes
};

class Image {
 public:
  // Makes an image of zeros. `name` is for errors. Error (no_device) with the numbers when the device does
  // not have images of that format or size, or too little memory.
  Image(Device& device, const ImageShape& shape, std::string name);
  ~Image();
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;

  const ImageShape& shape() const { return shape_; }
  // Bytes of its texels.
  size_t size() const { return bytes_; }
  // Sets all texels: x first, then y, then z or the layers.
  void upload(std::span<const std::byte> bytes);
  // All texels, valid until the next read or dispatch.
  std::span<const std::byte> read();

 private:
  friend class Kernel;
  struct Objects;  // Vulkan's objects

  void check_device() const;
  void create();

  std::shared_ptr<Context> context_;
  std::string name_;
  ImageShape shape_;
  size_t bytes_ = 0;
  std::unique_ptr<RawBuffer> copy_;  // mapped; on the emulator the texels themselves
  std::unique_ptr<Objects> objects_;
};

}  // namespace eyeray::engine::gpu
