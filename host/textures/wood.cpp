#include <algorithm>
#include <cmath>

#include "host/textures/pattern.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

extern const TextureType wood_type;

namespace {

constexpr std::string_view manual = R"(Rings around the z axis, one per unit, displaced by noise.
)";

constexpr Key keys[] = {
    colors_key("[[0, [0.55, 0.33, 0.16]], [1, [0.3, 0.16, 0.07]]]"),
    octaves_key,
    {.name = "turbulence",
     .type = KeyType::number,
     .doc = "Displacement of the layers by the noise.",
     .fallback = "0.1",
     .min = 0,
     .max = 100},
    pattern_transform_key,
};

class Wood final : public Pattern {
 public:
  explicit Wood(const TableReader& table)
      : Pattern(table, shader::TEXTURE_wood,
                Vec4(double(table.integer("octaves")), table.number("turbulence"), 0, 0)),
        octaves_(int(table.integer("octaves"))),
        turbulence_(table.number("turbulence")) {}

 protected:
  double share(const Vec3& p) const override {
    return triangle_wave(std::hypot(p.x, p.y) + turbulence_ * turbulence(p, octaves_));
  }

 private:
  int octaves_;
  double turbulence_;
};

TexturePtr parse(TableReader& table) {
  return pattern_stands(table) ? std::make_shared<Wood>(table) : nullptr;
}

}  // namespace

extern const TextureType wood_type{.name = "wood", .manual = manual, .keys = keys, .parse = parse};

}  // namespace eyeray::engine::textures
