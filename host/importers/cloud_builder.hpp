// Turns the points of a file into a PointCloud that keeps the promises of scene/point_cloud.hpp. Private to
// the importers.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/scene/point_cloud.hpp"

namespace eyeray::engine::importers {

// The points of a file, any numbers.
struct RawPoints {
  std::string name;  // for messages
  std::vector<Vec3> positions;
  std::vector<Vec3> colors = {};  // linear RGB from 0 to 1, one a point; or empty
};

// Leaves out points that are not finite or out of range, with a warning that counts them. `size` is the
// diameter of the spheres; if it is absent, closing_radius() decides. Null if no point is left.
std::shared_ptr<PointCloud> build_cloud(RawPoints raw, std::optional<double> size,
                                        std::vector<std::string>& warnings);

// The radius of spheres around points of a surface that leaves few gaps between them. On a square grid it is
// 3/4 of the grid's width, a little more than half a diagonal. It grows as the points are less regular, since
// gaps between points at random are wider. Points at the same position count as one.
double closing_radius(std::span<const Vec3> positions);

// Warns of values of points that are not shown: "2 of its fields were left out: ring, intensity".
void report_left_out(std::string_view fields, std::vector<std::string> names,
                     std::vector<std::string>& warnings);

}  // namespace eyeray::engine::importers
