// The projection of the world onto a picture: the forward map, from points to pixels, which camera rays
// follow backwards. Written from docs/scene-reference.md's cameras, not from the shaders and not from the
// reference's rays.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/core/rect.hpp"
#include "host/core/vec.hpp"
#include "host/scene/camera.hpp"

namespace eyeray::engine::raster {

// A triangle on the picture. Each corner has x to the right and y down, in pixels from the area's top left,
// so that a pixel's centre is at one half. Its third coordinate is its nearness, which is linear between
// corners.
struct ScreenTriangle {
  std::array<Vec3, 3> at{};
  uint32_t id = 0;   // the primitive's
  double bound = 0;  // largest distance of the true surface, in the world; 0 if it is flat
  double reach = 0;  // largest distance of the whole shape or mesh from the eye; 0 for planes
};

// Gate C's allowance for a hit close to something large: two units in the last place, as a share of the
// largest coordinate.
inline constexpr double coordinate_error = 0x1p-22;

class View {
 public:
  // The view of the pixels `area` of a picture of `size`. Error (bad_input) for a camera that no projection
  // matrix describes.
  View(const Camera& camera, const Vec2& size, const Rect& area);

  const Rect& area() const { return area_; }

  // A point in the camera's space: its distances to the right of the eye, above it, and in front of it.
  Vec3 to_camera(const Vec3& world) const;
  // A direction in the camera's space.
  Vec3 turned(const Vec3& direction) const;
  // The pixel position of a point in front of the eye, w = 1, or of a direction, w = 0.
  Vec3 project(const Vec4& point) const;

  // Nearness is greater for nearer points: 1 / depth in perspective, −depth for parallel rays, where depth is
  // measured along the viewing direction. Either nearness is linear over the picture of a plane.
  bool perspective() const { return perspective_; }
  // The nearness of the hit at `t` along the ray through the centre of a pixel of the area.
  double nearness(int x, int y, double t) const;
  // The inverse of nearness(): t along the ray.
  double t(int x, int y, double nearness) const;
  // The error of the nearness if t has the relative error `share`.
  double nearness_error(double nearness, double share) const;
  // The number of pixels by which a point of that nearness is displaced, and the gain of its nearness, if it
  // moves by `distance` in the world; infinite if that takes it behind the eye.
  Vec2 shift(double x, double y, double nearness, double distance) const;
  // The size of a pixel at a depth, in units of the world.
  double pixel_at(double depth) const { return perspective_ ? depth / focal_ : 1 / focal_; }
  // True if a ball in the camera's space may be seen.
  bool may_see(const Vec3& center, double radius) const;

  // Cuts a convex polygon to the part in front of the eye and near the picture: a region some pictures wide,
  // in which float32 can resolve all corners. Calls visit(ScreenTriangle) for the triangles of this part,
  // which are `like` with other corners. Two polygons that share an edge get bitwise the same cut point on
  // it.
  template <typename Visit>
  void cut(std::span<const Vec4> polygon, const ScreenTriangle& like, const Visit& visit) const {
    Polygon left(polygon);
    if (!cut_to_guard(left)) return;
    const Vec3 first = project(left.at[0]);
    Vec3 before = project(left.at[1]);
    for (size_t i = 2; i < left.count; ++i) {
      const Vec3 next = project(left.at[i]);
      visit(ScreenTriangle{{first, before, next}, like.id, like.bound, like.reach});
      before = next;
    }
  }
  // The plane through `point` perpendicular to `normal`, as a polygon for `cut` that covers the region that
  // `cut` keeps. Empty if the plane is seen edge-on.
  std::vector<Vec4> plane(const Vec3& point, const Vec3& normal) const;

 private:
  struct Polygon {
    explicit Polygon(std::span<const Vec4> corners);
    std::array<Vec4, 16> at;
    size_t count;
  };
  bool cut_to_guard(Polygon& polygon) const;
  Vec4 side(int number) const;
  double slant(int x, int y) const;

  CameraAxes axes_;
  Rect area_;
  bool perspective_;
  double focal_;  // pixels of a width of 1: at depth 1, or at any depth for parallel rays
  Vec2 middle_;   // the pixel position of the viewing direction, from the area's top left
};

}  // namespace eyeray::engine::raster
