// The meanings of the properties of vertices and faces of PLY files. Private to the importers.
#pragma once

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "host/importers/ply_header.hpp"

namespace eyeray::engine::importers {

// The meaning of a vertex's property; `none` if it has none here.
enum Slot { x, y, z, nx, ny, nz, u, v, red, green, blue, alpha, none };

inline constexpr std::pair<std::string_view, Slot> slot_names[] = {
    {"x", x},
    {"y", y},
    {"z", z},
    {"nx", nx},
    {"ny", ny},
    {"nz", nz},
    {"s", u},
    {"t", v},
    {"u", u},
    {"v", v},
    {"texture_u", u},
    {"texture_v", v},
    {"texture_s", u},
    {"texture_t", v},
    {"red", red},
    {"green", green},
    {"blue", blue},
    {"r", red},
    {"g", green},
    {"b", blue},
    {"diffuse_red", red},
    {"diffuse_green", green},
    {"diffuse_blue", blue},
    {"alpha", alpha},
    {"a", alpha},
    {"diffuse_alpha", alpha},
};

inline Slot slot_of(std::string_view name) {
  const auto known = std::ranges::find(slot_names, name, [](const auto& row) { return row.first; });
  return known == std::end(slot_names) ? none : known->second;
}

// True if a point without faces shows the property, or if another warning covers it. `normals`: whether it
// shows normals.
inline bool is_shown_of_points(const PlyProperty& property, bool normals) {
  const Slot slot = slot_of(property.name);
  return !property.list && (slot <= (normals ? nz : z) || (slot >= red && slot <= alpha));
}

// The value of full brightness in a colour of this type.
inline double brightest(PlyType type) {
  switch (type) {
    case PlyType::uint8:
    case PlyType::int8:
      return 255;
    case PlyType::uint16:
    case PlyType::int16:
      return 65535;
    default:
      return 1;
  }
}

}  // namespace eyeray::engine::importers
