// What an accessor's `componentType` and `type` say. Private to the importers.
// Source: Khronos Group: glTF 2.0 Specification (2.0.1), 3.6.2.2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace eyeray {

// Numbers of the specification.
enum GltfComponent : uint64_t {
  signed_byte = 5120,
  unsigned_byte = 5121,
  signed_short = 5122,
  unsigned_short = 5123,
  unsigned_int = 5125,
  floating = 5126
};

// 0 for a componentType that there is not.
constexpr size_t bytes_of(uint64_t component) {
  switch (component) {
    case signed_byte:
    case unsigned_byte:
      return 1;
    case signed_short:
    case unsigned_short:
      return 2;
    case unsigned_int:
    case floating:
      return 4;
    default:
      return 0;
  }
}

// 0 for what a vertex does not have: matrices, and types that there are not.
constexpr size_t components_of(std::string_view type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 0;
}

}  // namespace eyeray
