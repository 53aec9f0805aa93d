// Keys that several shapes have.
#pragma once

#include "scene/affine.hpp"
#include "scene/table_reader.hpp"

namespace eyeray {

inline constexpr Key center_key = {
    .name = "center", .type = KeyType::vec3, .doc = "Centre.", .min = -max_coordinate, .max = max_coordinate};

inline constexpr Key radii_key = {.name = "radii",
                                  .type = KeyType::vec3,
                                  .doc = "Half the extents along x, y and z.",
                                  .min = min_radius,
                                  .max = max_coordinate};

// The keys of shapes with an axis.
inline constexpr Key axis_from_key = {.name = "from",
                                      .type = KeyType::vec3,
                                      .doc = "Where the axis begins.",
                                      .min = -max_coordinate,
                                      .max = max_coordinate};
inline constexpr Key axis_to_key = {.name = "to",
                                    .type = KeyType::vec3,
                                    .doc = "Where it ends.",
                                    .min = -max_coordinate,
                                    .max = max_coordinate};

// The keys of shapes in a box.
inline constexpr Key box_min_key = {.name = "min",
                                    .type = KeyType::vec3,
                                    .doc = "The corner of the box with the least coordinates.",
                                    .min = -max_coordinate,
                                    .max = max_coordinate};
inline constexpr Key box_max_key = {.name = "max",
                                    .type = KeyType::vec3,
                                    .doc = "The corner with the greatest.",
                                    .min = -max_coordinate,
                                    .max = max_coordinate};
inline constexpr Key box_open_key = {.name = "open",
                                     .type = KeyType::boolean,
                                     .doc = "Whether the box's faces are left out.",
                                     .fallback = "false"};

}  // namespace eyeray
