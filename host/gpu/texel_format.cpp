#include "host/gpu/texel_format.hpp"

#include <spirv/unified1/spirv.hpp>

#include <algorithm>

#include "host/gpu/vulkan.hpp"

namespace eyeray::engine::gpu {
namespace {

using Kind = emulator::Format::Kind;

constexpr TexelFormat all_formats[] = {
    {"rgba32f", spv::ImageFormatRgba32f, VK_FORMAT_R32G32B32A32_SFLOAT, {Kind::real, 4, 32}},
    {"rgba16f", spv::ImageFormatRgba16f, VK_FORMAT_R16G16B16A16_SFLOAT, {Kind::real, 4, 16}},
    {"rg32f", spv::ImageFormatRg32f, VK_FORMAT_R32G32_SFLOAT, {Kind::real, 2, 32}},
    {"rg16f", spv::ImageFormatRg16f, VK_FORMAT_R16G16_SFLOAT, {Kind::real, 2, 16}},
    {"r32f", spv::ImageFormatR32f, VK_FORMAT_R32_SFLOAT, {Kind::real, 1, 32}},
    {"r16f", spv::ImageFormatR16f, VK_FORMAT_R16_SFLOAT, {Kind::real, 1, 16}},
    {"rgba8", spv::ImageFormatRgba8, VK_FORMAT_R8G8B8A8_UNORM, {Kind::unorm, 4, 8}},
    {"rg8", spv::ImageFormatRg8, VK_FORMAT_R8G8_UNORM, {Kind::unorm, 2, 8}},
    {"r8", spv::ImageFormatR8, VK_FORMAT_R8_UNORM, {Kind::unorm, 1, 8}},
    {"rgba8_snorm", spv::ImageFormatRgba8Snorm, VK_FORMAT_R8G8B8A8_SNORM, {Kind::snorm, 4, 8}},
    {"rgba32i", spv::ImageFormatRgba32i, VK_FORMAT_R32G32B32A32_SINT, {Kind::integer, 4, 32}},
    {"rgba16i", spv::ImageFormatRgba16i, VK_FORMAT_R16G16B16A16_SINT, {Kind::integer, 4, 16}},
    {"rgba8i", spv::ImageFormatRgba8i, VK_FORMAT_R8G8B8A8_SINT, {Kind::integer, 4, 8}},
    {"rg32i", spv::ImageFormatRg32i, VK_FORMAT_R32G32_SINT, {Kind::integer, 2, 32}},
    {"r32i", spv::ImageFormatR32i, VK_FORMAT_R32_SINT, {Kind::integer, 1, 32}},
    {"rgba32ui", spv::ImageFormatRgba32ui, VK_FORMAT_R32G32B32A32_UINT, {Kind::natural, 4, 32}},
    {"rgba16ui", spv::ImageFormatRgba16ui, VK_FORMAT_R16G16B16A16_UINT, {Kind::natural, 4, 16}},
    {"rgba8ui", spv::ImageFormatRgba8ui, VK_FORMAT_R8G8B8A8_UINT, {Kind::natural, 4, 8}},
    {"rg32ui", spv::ImageFormatRg32ui, VK_FORMAT_R32G32_UINT, {Kind::natural, 2, 32}},
    {"r32ui", spv::ImageFormatR32ui, VK_FORMAT_R32_UINT, {Kind::natural, 1, 32}},
};

template <typename T>
const TexelFormat* find(T TexelFormat::* member, T value) {
  const auto found = std::ranges::find(all_formats, value, member);
  return found == std::end(all_formats) ? nullptr : &*found;
}

}  // namespace

std::span<const TexelFormat> texel_formats() {
  return all_formats;
}

const TexelFormat* find_format(std::string_view name) {
  return find(&TexelFormat::name, name);
}
const TexelFormat* find_format(uint32_t spirv) {
  return find(&TexelFormat::spirv, spirv);
}

std::string format_names() {
  std::string names;
  for (const TexelFormat& each : all_formats) names.append(names.empty() ? "" : ", ").append(each.name);
  return names;
}

bool read_image_type(std::span<const uint32_t> i, ReflectedImage& image) {
  if ((i[0] & spv::OpCodeMask) != spv::OpTypeImage || i[3] > spv::Dim3D || i[6] != 0 || i[7] == 0)
    return false;
  image.axes = i[3] + 1;
  image.arrayed = i[5] != 0;
  image.sampled = i[7] == 1;
  image.spirv_format = i[8];
  image.format = find_format(i[8]);
  return true;
}

}  // namespace eyeray::engine::gpu
