// The meaning of an accessor's `componentType` and `type`. Private to the importers.
// Source: Khronos Group: glTF 2.0 Specification (2.0.1), 3.6.2.2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace eyeray::engine::importers {

// The specification's numbers for component types.
enum GltfComponent : uint64_t {
  signed_byte = 5120,
  unsigned_byte = 5121,
  signed_short = 5122,
  unsigned_short = 5123,
  unsigned_int = 5125,
  floating = 5126
};

// Calls `visit` with a 0 of the component's C++ type (float for an unknown componentType); returns its
// result.
template <typename Visit>
constexpr auto visit_component(uint64_t component, const Visit& visit) {
  switch (component) {
    case signed_byte:
      return visit(int8_t{});
    case unsigned_byte:
      return visit(uint8_t{});
    case signed_short:
      return visit(int16_t{});
    case unsigned_short:
      return visit(uint16_t{});
    case unsigned_int:
      return visit(uint32_t{});
    default:
      return visit(float{});
  }
}

// Size of a component in bytes; 0 for an unknown componentType.
constexpr size_t bytes_of(uint64_t component) {
  const bool known = (component >= signed_byte && component <= unsigned_short) || component == unsigned_int ||
                     component == floating;
  return known ? visit_component(component, [](auto zero) { return sizeof zero; }) : 0;
}

// Number of components; 0 for types that a vertex does not have, which are matrices and unknown types.
constexpr size_t components_of(std::string_view type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 0;
}

}  // namespace eyeray::engine::importers
