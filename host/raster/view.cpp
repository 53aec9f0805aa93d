#include "host/raster/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/core/error.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::raster {
namespace {

// The margin that is kept on each side of the picture, in units of its size along that axis.
constexpr double guard = 3;
// The least depth that is kept: nothing that a scene can hold is nearer to the eye.
constexpr double nearest = min_radius;
constexpr int sides = 6;

// The number of pixels of a width of 1 at depth 1.
double perspective_focal(const PerspectiveCamera& camera, const Vec2& size) {
  double along = size.x;
  if (camera.fov_axis == FovAxis::vertical) along = size.y;
  if (camera.fov_axis == FovAxis::shorter) along = std::min(size.x, size.y);
  if (camera.fov_axis == FovAxis::diagonal) along = std::hypot(size.x, size.y);
  return along / 2 / std::tan(camera.fov_degrees * std::numbers::pi / 360);
}

bool before(const Vec4& a, const Vec4& b) {
  for (int i = 0; i < 4; ++i)
    if (a[i] != b[i]) return a[i] < b[i];
  return false;
}

}  // namespace

View::View(const Camera& camera, const Vec2& size, const Rect& area)
    : axes_(camera_axes(camera)), area_(area), middle_(size / 2.0 - Vec2(area.x, area.y)) {
  const CameraForm form = camera.projection->form();
  const auto* const pinhole = std::get_if<PerspectiveCamera>(&form);
  const auto* const parallel = std::get_if<OrthographicCamera>(&form);
  const bool lens = pinhole && pinhole->aperture.radius > 0;
  if (lens || (!pinhole && !parallel))
    throw Error(ExitCode::bad_input,
                "--raster needs a camera that a projection matrix describes: a perspective camera without an "
                "aperture, or an orthographic one; this {}: leave out --raster",
                lens ? "camera has a lens" : "camera is another");
  perspective_ = pinhole != nullptr;
  focal_ = pinhole ? perspective_focal(*pinhole, size) : size.x / (2 * parallel->size);
}

Vec3 View::turned(const Vec3& d) const {
  return {glm::dot(d, axes_.u), glm::dot(d, axes_.v), glm::dot(d, axes_.w)};
}
Vec3 View::to_camera(const Vec3& world) const {
  return turned(world - axes_.eye);
}

Vec3 View::project(const Vec4& p) const {
  const double scale = perspective_ ? focal_ / p.z : focal_;
  return {middle_.x + scale * p.x, middle_.y - scale * p.y, perspective_ ? p.w / p.z : -p.z};
}

double View::nearness(int x, int y, double t) const {
  return perspective_ ? slant(x, y) / t : -t;
}
double View::t(int x, int y, double nearness) const {
  return perspective_ ? slant(x, y) / nearness : -nearness;
}

// The ratio of distance to depth along the ray through a pixel's centre: ray directions have unit length.
double View::slant(int x, int y) const {
  const double across = std::hypot(x + 0.5 - middle_.x, y + 0.5 - middle_.y) / focal_;
  return std::hypot(1.0, across);
}

double View::nearness_error(double nearness, double share) const {
  return share * std::fabs(nearness);
}

Vec2 View::shift(double x, double y, double nearness, double distance) const {
  if (!perspective_) return {distance * focal_, distance};
  const double across = std::hypot(x - middle_.x, y - middle_.y) / focal_;
  const double least = 1 / nearness - distance;
  if (!(least > 0)) return Vec2(std::numeric_limits<double>::infinity());
  return {focal_ * distance * std::hypot(1.0, across) / least, nearness * distance / least};
}

// A plane that bounds the drawn part of space; its product with a point is above 0 on the inner side.
Vec4 View::side(int number) const {
  const Vec2 size(area_.width, area_.height);
  const bool along_y = number >= 2;
  const double width = std::max(along_y ? size.y : size.x, 64.0);
  const double middle = along_y ? middle_.y : middle_.x;
  // The planes keep middle ± scale · coordinate between −guard · width and size + guard · width.
  const double sign = along_y ? -1 : 1;
  const double turn = number % 2 == 0 ? 1 : -1;
  const double offset =
      turn > 0 ? middle + guard * width : (along_y ? size.y : size.x) + guard * width - middle;
  Vec4 plane(0.0);
  plane[along_y ? 1 : 0] = turn * sign * focal_;
  plane[perspective_ ? 2 : 3] = offset;
  if (number < 4) return plane;
  // Side 4 keeps points in front of the eye. Side 5 keeps w ≥ 0: nothing beyond infinity.
  if (number == 4) return {0, 0, 1, perspective_ ? -nearest : 0};
  return {0, 0, 0, 1};
}

View::Polygon::Polygon(std::span<const Vec4> corners) : count(corners.size()) {
  std::ranges::copy(corners, at.begin());
}

bool View::cut_to_guard(Polygon& polygon) const {
  for (int number = 0; number < sides; ++number) {
    const Vec4 plane = side(number);
    std::array<double, 16> above;
    bool all = true, none = true;
    for (size_t i = 0; i < polygon.count; ++i) {
      above[i] = glm::dot(plane, polygon.at[i]);
      (above[i] >= 0 ? none : all) = false;
    }
    if (none) return false;
    if (all) continue;
    Polygon left({});
    for (size_t i = 0; i < polygon.count; ++i) {
      const size_t next = (i + 1) % polygon.count;
      if (above[i] >= 0) left.at[left.count++] = polygon.at[i];
      if ((above[i] >= 0) == (above[next] >= 0)) continue;
      // Interpolate from the same end in every polygon that has the edge.
      const bool turned = before(polygon.at[next], polygon.at[i]);
      const size_t from = turned ? next : i, to = turned ? i : next;
      const double share = above[from] / (above[from] - above[to]);
      left.at[left.count++] = polygon.at[from] + (polygon.at[to] - polygon.at[from]) * share;
    }
    if (left.count < 3) return false;
    polygon = left;
  }
  return true;
}

bool View::may_see(const Vec3& center, double radius) const {
  for (int number = 0; number < 5; ++number) {
    const Vec4 plane = side(number);
    if (glm::dot(plane, Vec4(center, 1.0)) < -radius * glm::length(Vec3(plane))) return false;
  }
  return true;
}

std::vector<Vec4> View::plane(const Vec3& point, const Vec3& normal) const {
  // In the camera's space: n · p = height.
  const Vec3 n = turned(normal);
  const double height = glm::dot(n, to_camera(point));
  std::vector<Vec4> corners;
  const double right = (area_.width + guard * std::max(area_.width, 64)) - middle_.x;
  const double left = -guard * std::max(area_.width, 64) - middle_.x;
  const double low = middle_.y - (area_.height + guard * std::max(area_.height, 64));
  const double high = middle_.y + guard * std::max(area_.height, 64);
  for (const Vec2& corner : {Vec2(left, low), Vec2(right, low), Vec2(right, high), Vec2(left, high)}) {
    const Vec2 p = corner / focal_;
    if (perspective_) {
      // Along the direction (p, 1) the distance to the plane is height / (n · direction). If it is below 0,
      // the direction never reaches the plane.
      if (height == 0) return {};
      corners.push_back({p, 1.0, glm::dot(n, Vec3(p, 1.0)) / height});
    } else {
      if (n.z == 0) return {};
      corners.push_back({p, (height - n.x * p.x - n.y * p.y) / n.z, 1.0});
    }
  }
  return corners;
}

}  // namespace eyeray::engine::raster
