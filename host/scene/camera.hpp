// The interface of cameras, in float64. A camera is one .cpp in host/cameras, one .glsl in shaders/cameras
// and one row in cameras/rows.h.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine {

namespace formula {
class Formula;  // formula/formula.hpp
}

// The position of a camera, and its unit axes: image right, image up, viewing direction.
struct CameraAxes {
  Vec3 eye, u, v, w;
};

// Cameras in the terms that other programs share.
enum class FovAxis { horizontal, vertical, shorter, diagonal };
inline constexpr std::string_view fov_axis_names[] = {"horizontal", "vertical", "shorter", "diagonal"};

// The aperture, from which rays start: a disk or a polygon around the eye. Points in the plane at `focus` are
// sharp.
struct Aperture {
  // 0: all rays start at the eye. For a polygon, the radius of the circle through its corners.
  double radius = 0;
  double focus = 1;           // distance of sharp points from the eye, along the viewing direction
  int blades = 0;             // number of corners; 0: a disk
  double blade_rotation = 0;  // angle of the first corner, from right towards up, in radians
};

struct PerspectiveCamera {
  double fov_degrees = 45;  // full angle along fov_axis
  FovAxis fov_axis = FovAxis::horizontal;
  Aperture aperture = {};
};

struct OrthographicCamera {
  double size = 1;  // half the width of the view
};

struct FisheyeCamera {
  double fov_degrees = 180;             // full angle that the circle spans
  FovAxis fov_axis = FovAxis::shorter;  // the side of the picture that is as long as the circle is wide
};

struct PanoramaCamera {
  double fov_degrees = 360;  // angle that the picture's width spans; the height spans as much per pixel
};

struct CylindricalCamera {
  double fov_degrees = 180;  // angle that the picture's width spans
};

// monostate: cameras that other programs have no word for.
using CameraForm = std::variant<std::monostate, PerspectiveCamera, OrthographicCamera, FisheyeCamera,
                                PanoramaCamera, CylindricalCamera>;

// A line of `eyeray check` and the numbers in it, as JSON names them.
struct CameraFact {
  std::string_view label;
  std::string text;
  std::vector<std::pair<std::string_view, double>> numbers;
};

// The kind of a camera: which ray passes a point in the picture. `size` is the picture's, in pixels.
class Projection {
 public:
  virtual ~Projection() = default;

  // The projection's number in cameras/rows.h: shader::CAMERA_NAME.
  virtual uint32_t kind() const = 0;
  // The lengths of the shaders' `right`, `up` and `forward` as multiples of the axes. X·right + Y·up, with X
  // and Y in [−1, 1], spans the picture.
  virtual Vec3 scale(const Vec2& size) const = 0;
  // The ray through `position`, with a unit direction. `position` is relative to the picture's middle, to the
  // right and up, in half widths. If rays start on an aperture, the ray starts at `lens`, to the right and up
  // of the eye. This is the reference's version: written from the mathematics, not from `scale` and the
  // shader.
  virtual Ray ray(const CameraAxes& camera, const Vec2& position, const Vec2& lens,
                  const Vec2& size) const = 0;
  // True if the camera sees anything at this point; else the picture is black there.
  virtual bool sees(const Vec2& /*position*/, const Vec2& /*lens*/, const Vec2& /*size*/) const {
    return true;
  }
  // The formula of a camera that a scene defines; null for any other camera.
  virtual std::shared_ptr<const formula::Formula> function() const { return nullptr; }
  virtual Aperture aperture() const { return {}; }
  // The projection that shows `factor` times the width in a picture of this size, at the same scale in both
  // directions.
  virtual std::shared_ptr<const Projection> widened(double factor, const Vec2& size) const = 0;
  virtual std::vector<CameraFact> facts(const Vec2& size) const = 0;
  virtual CameraForm form() const { return {}; }
};

struct Camera {
  Vec3 eye{0, 0, 5};
  Vec3 target{0, 0, 0};
  Vec3 up{0, 1, 0};
  std::shared_ptr<const Projection> projection;  // not null in a complete scene
};

// The eye and the axes of a camera, by docs/conventions.md.
CameraAxes camera_axes(const Camera& camera);

// The scaled axes that the shaders use.
struct CameraFrame {
  Vec3 right, up, forward;
};
CameraFrame camera_frame(const Camera& camera, const Vec2& size);

}  // namespace eyeray::engine
