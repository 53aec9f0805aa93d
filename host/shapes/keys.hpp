// Keys that several shapes have.
#pragma once

#include "host/scene/affine.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

constexpr Key point_key(std::string_view name, std::string_view doc) {
  return {.name = name, .type = KeyType::vec3, .doc = doc, .min = -max_coordinate, .max = max_coordinate};
}

inline constexpr Key center_key = point_key("center", "Centre.");
inline constexpr Key radii_key = {.name = "radii",
                                  .type = KeyType::vec3,
                                  .doc = "Half the extents along x, y and z.",
                                  .min = min_radius,
                                  .max = max_coordinate};

// Keys of shapes with an axis.
inline constexpr Key axis_from_key = point_key("from", "Start of the axis.");
inline constexpr Key axis_to_key = point_key("to", "End of the axis.");

// Keys of shapes in a box.
inline constexpr Key box_min_key = point_key("min", "The corner of the box with the least coordinates.");
inline constexpr Key box_max_key = point_key("max", "The corner of the box with the greatest coordinates.");
inline constexpr Key box_open_key = {.name = "open",
                                     .type = KeyType::boolean,
                                     .doc = "If true, the box's faces are left out.",
                                     .fallback = "false"};

}  // namespace eyeray::engine::shapes
