// Points that are shown as spheres or disks: those of a scan, or of a scene's table.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine {

// The code that makes a cloud must ensure that it has a point, and that every value is finite.
struct PointCloud {
  std::string name;  // for messages: the file, and the cloud's name there
  std::vector<Vec3> positions;
  std::vector<glm::vec3> colors = {};  // linear RGB from 0 to 1, one a point; empty: white
  // Unit vectors, one a point: the point is a disk perpendicular to it, or a sphere if it is 0. Empty: all
  // points are spheres.
  std::vector<glm::vec3> normals = {};
  double radius = 0;  // radius of all spheres and disks, above 0
};

}  // namespace eyeray::engine
