#include <algorithm>
#include <cmath>

#include "host/textures/pattern.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

extern const TextureType noise_type;

namespace {

constexpr std::string_view manual =
    R"(Clouds: gradient noise (Perlin 2002). Its coarsest bumps have the size of one unit.
)";

constexpr Key keys[] = {
    colors_key("[[0, 0], [1, 1]]"),
    octaves_key,
    pattern_transform_key,
};

class Noise final : public Pattern {
 public:
  explicit Noise(const TableReader& table)
      : Pattern(table, shader::TEXTURE_noise, Vec4(double(table.integer("octaves")), 0, 0, 0)),
        octaves_(int(table.integer("octaves"))) {}

 protected:
  double share(const Vec3& p) const override {
    return std::clamp(0.5 + 0.5 * turbulence(p, octaves_), 0.0, 1.0);
  }

 private:
  int octaves_;
};

TexturePtr parse(TableReader& table) {
  return pattern_stands(table) ? std::make_shared<Noise>(table) : nullptr;
}

}  // namespace

extern const TextureType noise_type{.name = "noise", .manual = manual, .keys = keys, .parse = parse};

}  // namespace eyeray::engine::textures
