#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/ranges.h>

#include "host/emulator/access.hpp"
#include "host/emulator/executes.hpp"

namespace eyeray::engine::emulator {
namespace {

bool is_signed(Format::Kind kind) {
  return kind == Format::Kind::integer || kind == Format::Kind::snorm;
}
bool is_normalised(Format::Kind kind) {
  return kind == Format::Kind::unorm || kind == Format::Kind::snorm;
}

// The greatest whole number of a normalised format, which stands for 1.
float steps(const Format& format) {
  return float((uint64_t{1} << (format.bits - is_signed(format.kind))) - 1);
}

// A component of a texel as the kernel's number. One that the format does not have is 0, or 1 for the last.
uint32_t read_component(const Format& format, const std::byte* texel, uint32_t component) {
  const bool whole = format.kind == Format::Kind::natural || format.kind == Format::Kind::integer;
  if (component >= format.components) return component < 3 ? 0 : whole ? 1 : std::bit_cast<uint32_t>(1.0f);
  uint32_t word = 0;
  std::memcpy(&word, texel + component * format.bits / 8, format.bits / 8);
  if (is_signed(format.kind)) word = uint32_t(int32_t(word << (32 - format.bits)) >> (32 - format.bits));
  if (format.kind == Format::Kind::unorm) return std::bit_cast<uint32_t>(float(word) / steps(format));
  if (format.kind == Format::Kind::snorm)
    return std::bit_cast<uint32_t>(std::max(float(int32_t(word)) / steps(format), -1.0f));
  if (format.kind == Format::Kind::real && format.bits == 16)
    return std::bit_cast<uint32_t>(half_to_float(word));
  return word;
}

void write_component(const Format& format, std::byte* texel, uint32_t component, uint32_t word) {
  if (is_normalised(format.kind)) {
    const float x = std::bit_cast<float>(word), low = is_signed(format.kind) ? -1.0f : 0.0f;
    word = uint32_t(int32_t(std::nearbyint(std::isnan(x) ? 0 : std::clamp(x, low, 1.0f) * steps(format))));
  } else if (format.kind == Format::Kind::real && format.bits == 16) {
    word = to_half(double(std::bit_cast<float>(word)));
  }
  std::memcpy(texel + component * format.bits / 8, &word, format.bits / 8);
}

struct Texel {
  size_t byte = 0;         // its first
  uint32_t axis = within;  // the first axis along which it is outside of the image
  static constexpr uint32_t within = 3, level = 4;
};

// The coordinates are o.from[0]. o.literals: the numbers of the operands that are the level and an offset, or
// 0. An offset has no layer.
int64_t coordinate(const Group& group, const Operation& o, uint32_t lane, uint32_t axis) {
  const int64_t x = int32_t(group.read(o.from[0], axis)[lane]);
  const uint32_t offset = o.literals[1];
  return offset && axis < o.from[offset].words ? x + int32_t(group.read(o.from[offset], axis)[lane]) : x;
}

Texel find_texel(const Group& group, const Operation& o, const Image& image, uint32_t lane) {
  Texel texel;
  if (o.literals[0] && group.read(o.from[o.literals[0]], 0)[lane] != 0) return {.axis = Texel::level};
  size_t stride = image.format.bytes();
  for (uint32_t axis = 0; axis < std::min(3u, o.from[0].words); ++axis) {
    const int64_t x = coordinate(group, o, lane, axis);
    if (x < 0 || x >= image.extent[axis]) return {.axis = axis};
    texel.byte += size_t(x) * stride;
    stride *= image.extent[axis];
  }
  return texel;
}

// The same, and reports a texel outside of the image.
Texel find_texel_to_access(Group& group, const Operation& o, const Image& image, uint32_t lane) {
  const Texel texel = find_texel(group, o, image, lane);
  if (texel.axis == Texel::within) return texel;
  std::vector<int64_t> at;
  for (uint32_t axis = 0; axis < std::min(3u, o.from[0].words); ++axis)
    at.push_back(coordinate(group, o, lane, axis));
  report_outside(group, o, lane,
                 texel.axis == Texel::level
                     ? fmt::format("level {} of 1", int32_t(group.read(o.from[o.literals[0]], 0)[lane]))
                     : fmt::format("texel {} of {}", fmt::join(at, ", "),
                                   fmt::join(std::span(image.extent).first(at.size()), ", ")));
  return texel;
}

void needs_texel(Group& group, const Operation& o) {
  group.needs_set(o, o.from[0], "a texel's number was never set");
  for (const uint32_t each : o.literals)
    if (each > 0) group.needs_set(o, o.from[each], "a texel's number was never set");
}

void read_texel(Group& group, const Operation& o) {
  needs_texel(group, o);
  const Image image = group.image(group.root(o).at);
  group.each_in_order([&](uint32_t lane) {
    const Texel texel = find_texel_to_access(group, o, image, lane);
    const bool inside = texel.axis == Texel::within;
    if (inside) note(group, o, lane, texel.byte, image.format.bytes(), false, false);
    for (uint32_t word = 0; word < o.words; ++word) {
      group.row(o.to + word)[lane] =
          inside ? read_component(image.format, &image.bytes[texel.byte], word) : 0;
      group.set_unset(o.to + word, lane, false);
    }
  });
}

// The texel's numbers are the last operand.
void write_texel(Group& group, const Operation& o) {
  needs_texel(group, o);
  const Source& value = o.from.back();
  group.needs_set(o, value, "a number was never set, and is stored into an image");
  const Image image = group.image(group.root(o).at);
  const bool real = image.format.kind != Format::Kind::natural && image.format.kind != Format::Kind::integer;
  group.each_in_order([&](uint32_t lane) {
    const Texel texel = find_texel_to_access(group, o, image, lane);
    if (texel.axis != Texel::within) return;
    note(group, o, lane, texel.byte, image.format.bytes(), true, false);
    for (uint32_t n = 0; n < image.format.components; ++n) {
      const uint32_t word = n < value.words ? group.read(value, n)[lane] : 0;
      write_component(image.format, &image.bytes[texel.byte], n, leave(group, o, lane, word, real ? 32 : 0));
    }
  });
}

// A pointer to a texel, for atomics.
void texel_pointer(Group& group, const Operation& o) {
  needs_texel(group, o);
  const Image image = group.image(group.root(o).at);
  group.each([&](uint32_t lane) {
    const Texel texel = find_texel(group, o, image, lane);
    const bool inside = texel.axis == Texel::within && texel.byte < nowhere;
    group.row(o.to)[lane] = inside ? uint32_t(texel.byte) : nowhere;
    if (texel.axis >= Texel::within) return;
    group.row(o.to + 1)[lane] = uint32_t(coordinate(group, o, lane, texel.axis));
    group.row(o.to + 2)[lane] = image.extent[texel.axis];
  });
}

void query_size(Group& group, const Operation& o) {
  const Image image = group.image(group.root(o).at);
  for (uint32_t word = 0; word < o.words; ++word)
    group.each([&](uint32_t lane) { group.row(o.to + word)[lane] = word < 3 ? image.extent[word] : 1; });
}

void query_levels(Group& group, const Operation& o) {
  group.each([&](uint32_t lane) { group.row(o.to)[lane] = 1; });
}

}  // namespace

Execute image_operation(spv::Op op) {
  switch (op) {
    case spv::OpImageRead:
    case spv::OpImageFetch:
      return read_texel;
    case spv::OpImageWrite:
      return write_texel;
    case spv::OpImageTexelPointer:
      return texel_pointer;
    case spv::OpImageQuerySize:
    case spv::OpImageQuerySizeLod:
      return query_size;
    case spv::OpImageQueryLevels:
      return query_levels;
    default:
      return nullptr;
  }
}

}  // namespace eyeray::engine::emulator
