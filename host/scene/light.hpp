// The interface of lights, in float64. A light is one .cpp in host/lights, one .glsl in shaders/lights and
// one row in lights/rows.h.
#pragma once

#include <memory>
#include <string_view>
#include <variant>

#include "host/core/vec.hpp"

namespace eyeray::engine {

namespace records {
class Packer;  // records/packer.hpp
}

// A light as a point sees it.
struct Illumination {
  Vec3 l;           // unit, towards the light
  Vec3 color;       // the arriving light if nothing is in between
  double distance;  // infinite for a light without a position
  // Half the angle under which the light is seen, in radians. The light is spread evenly over such a disk.
  double angle = 0;
};

// Lights in the terms that other programs share.
enum class Falloff { inverse_square, none };

struct PointLight {
  Vec3 position{0.0};
  Vec3 intensity{1.0};
  Falloff falloff = Falloff::inverse_square;
};

struct DirectionalLight {
  Vec3 to_light{0, 1, 0};  // unit, from the scene towards the light
  Vec3 intensity{1.0};
  double angle = 0;  // the angle under which the light is seen, in radians
};

// A spot light as in glTF: full intensity within the inner angle from its axis, and none beyond the outer
// one.
struct SpotLight {
  Vec3 position{0.0};
  Vec3 direction{0, -1, 0};  // unit, in which its light travels
  Vec3 intensity{1.0};
  double inner = 0, outer = 0;  // in radians, 0 ≤ inner < outer ≤ π / 2
};

// monostate: lights that other programs have no word for.
using LightForm = std::variant<std::monostate, PointLight, DirectionalLight, SpotLight>;

class Light {
 public:
  virtual ~Light() = default;

  // The light that arrives at `point` if nothing is in between. This is the reference's version: no float32.
  virtual Illumination illuminate(const Vec3& point) const = 0;
  // Appends the light's one record.
  virtual void pack(records::Packer& packer) const = 0;
  virtual LightForm form() const { return {}; }

  std::string_view type;  // the name of its table in a scene file
};

}  // namespace eyeray::engine
