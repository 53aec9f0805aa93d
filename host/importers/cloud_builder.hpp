// Turns the points of a file into a PointCloud that keeps the promises of scene/point_cloud.hpp. Private to
// the importers.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/importers/import.hpp"

namespace eyeray::engine::importers {

// The points of a file, any numbers.
struct RawPoints {
  std::string name;  // for messages
  std::vector<Vec3> positions;
  std::vector<Vec3> colors = {};   // linear RGB from 0 to 1, one a point; or empty
  std::vector<Vec3> normals = {};  // vectors of any length, one a point; or empty
};

// Leaves out points that are not finite or out of range, with a warning that counts them. If the options have
// no point_size, closing_radius() decides. Normals count only for disks. Null if no point is left. InputError
// if disks are wanted and there are no normals.
std::shared_ptr<PointCloud> build_cloud(RawPoints raw, const ImportOptions& options,
                                        std::vector<std::string>& warnings);

// The radius of spheres around points of a surface that leaves few gaps between them. On a square grid it is
// 3/4 of the grid's width, a little more than half a diagonal. It grows as the points are less regular, since
// gaps between points at random are wider. Points at the same position count as one.
double closing_radius(std::span<const Vec3> positions);

// Warns of values of points that are not shown: "2 of its fields were left out: ring, intensity".
void report_left_out(std::string_view fields, std::vector<std::string> names,
                     std::vector<std::string>& warnings);

}  // namespace eyeray::engine::importers
