// The formats of images, and images as shaders declare them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "host/emulator/emulator.hpp"

namespace eyeray::engine::gpu {

struct TexelFormat {
  std::string_view name;       // GLSL's: "rgba32f"
  uint32_t spirv = 0;          // spv::ImageFormat
  uint32_t vulkan = 0;         // VkFormat
  emulator::Format numbers{};  // the numbers of a texel
};

std::span<const TexelFormat> texel_formats();
// Null if there is none of that name, or number in SPIR-V.
const TexelFormat* find_format(std::string_view name);
const TexelFormat* find_format(uint32_t spirv);
// "rgba32f, rgba16f, …".
std::string format_names();

struct ReflectedImage {
  bool sampled = false;                 // false: a storage image
  bool combined = false;                // with a sampler
  bool arrayed = false;                 // its layers come after its other axes
  uint32_t axes = 2;                    // 1 to 3, without the layers
  uint32_t spirv_format = 0;            // spv::ImageFormat; 0: none is declared
  const TexelFormat* format = nullptr;  // null: none is declared, or one that eyeray does not have
  bool operator==(const ReflectedImage&) const = default;
  // Axes of its texels, layers included.
  uint32_t coordinates() const { return axes + arrayed; }
};

// Reads an OpTypeImage. False for cubes, texel buffers and images of several samples.
bool read_image_type(std::span<const uint32_t> instruction, ReflectedImage& image);

}  // namespace eyeray::engine::gpu
