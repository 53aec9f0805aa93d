#include <algorithm>
#include <cmath>

#include "host/textures/pattern.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

extern const TextureType marble_type;

namespace {

constexpr std::string_view manual =
    R"(Layers along x, one per unit, displaced by noise: 0 at whole numbers, 1 halfway between.
)";

constexpr Key keys[] = {
    colors_key("[[0, [0.9, 0.88, 0.85]], [0.8, [0.75, 0.72, 0.7]], [1, [0.25, 0.22, 0.24]]]"),
    octaves_key,
    {.name = "turbulence",
     .type = KeyType::number,
     .doc = "Displacement of the layers by the noise.",
     .fallback = "0.6",
     .min = 0,
     .max = 100},
    pattern_transform_key,
};

class Marble final : public Pattern {
 public:
  explicit Marble(const TableReader& table)
      : Pattern(table, shader::TEXTURE_marble,
                Vec4(double(table.integer("octaves")), table.number("turbulence"), 0, 0)),
        octaves_(int(table.integer("octaves"))),
        turbulence_(table.number("turbulence")) {}

 protected:
  double share(const Vec3& p) const override {
    return triangle_wave(p.x + turbulence_ * turbulence(p, octaves_));
  }

 private:
  int octaves_;
  double turbulence_;
};

TexturePtr parse(TableReader& table) {
  return pattern_stands(table) ? std::make_shared<Marble>(table) : nullptr;
}

}  // namespace

extern const TextureType marble_type{.name = "marble", .manual = manual, .keys = keys, .parse = parse};

}  // namespace eyeray::engine::textures
