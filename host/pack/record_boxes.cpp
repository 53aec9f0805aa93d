#include "host/pack/record_boxes.hpp"

#include <cmath>

namespace eyeray::engine::pack {
namespace {

float below(double x) {
  const float rounded = float(x);
  return double(rounded) <= x ? rounded : std::nextafter(rounded, -HUGE_VALF);
}
float above(double x) {
  return -below(-x);
}

}  // namespace

bvh::Box shape_box(const Bounds& bounds, const Vec3& origin) {
  bvh::Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = bounds.min[axis] - origin[axis];
    const double upper = bounds.max[axis] - origin[axis];
    const double room = 0x1p-22 * std::max(std::fabs(lower), std::fabs(upper));
    box.lower[axis] = below(lower - room);
    box.upper[axis] = above(upper + room);
  }
  return box;
}

std::pair<bvh::Box, bvh::Box> cut_triangle(const shader::Primitive& triangle, int axis, float position) {
  const glm::vec3 corners[] = {glm::vec3(triangle.a), glm::vec3(triangle.b), glm::vec3(triangle.c)};
  bvh::Box low, high;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 from(corners[i]);
    const glm::dvec3 to(corners[(i + 1) % 3]);
    const double plane = double(position);
    if (from[axis] <= plane) low.include(corners[i]);
    if (from[axis] >= plane) high.include(corners[i]);
    if ((from[axis] < plane && to[axis] > plane) || (from[axis] > plane && to[axis] < plane)) {
      // Both boxes take the crossing, rounded to either side.
      const glm::dvec3 crossing = from + (to - from) * ((plane - from[axis]) / (to[axis] - from[axis]));
      glm::vec3 lower, upper;
      for (int k = 0; k < 3; ++k) {
        lower[k] = k == axis ? position : std::nextafter(below(crossing[k]), -HUGE_VALF);
        upper[k] = k == axis ? position : std::nextafter(above(crossing[k]), HUGE_VALF);
      }
      for (bvh::Box* box : {&low, &high}) {
        box->include(lower);
        box->include(upper);
      }
    }
  }
  return {low, high};
}

bvh::Box instance_box(const shader::Instance& instance, const bvh::Box& local) {
  bvh::Box box;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(corner & 1 ? local.upper.x : local.lower.x, corner & 2 ? local.upper.y : local.lower.y,
                       corner & 4 ? local.upper.z : local.lower.z);
    for (int row = 0; row < 3; ++row) {
      const glm::dvec4 map(instance.to_world[row]);
      const double x = glm::dot(glm::dvec3(map), p) + map.w;
      const double room = 1e-6 * (glm::dot(glm::abs(glm::dvec3(map)), glm::abs(p)) + std::fabs(map.w));
      box.lower[row] = std::min(box.lower[row], below(x - room));
      box.upper[row] = std::max(box.upper[row], above(x + room));
    }
  }
  return box;
}

}  // namespace eyeray::engine::pack
