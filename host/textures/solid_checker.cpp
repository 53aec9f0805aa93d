#include <algorithm>
#include <cmath>

#include "host/textures/pattern.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

extern const TextureType solid_checker_type;

namespace {

constexpr std::string_view manual =
    R"(Cubes of side 1, alternately of the first and of the last color. Faces at whole numbers of the pattern are on
the border of two cubes: move the pattern a little.
)";

constexpr Key keys[] = {
    colors_key("[[0, 1], [1, 0]]"),
    pattern_transform_key,
};

class SolidChecker final : public Pattern {
 public:
  explicit SolidChecker(const TableReader& table) : Pattern(table, shader::TEXTURE_solid_checker) {}

 protected:
  double share(const Vec3& p) const override {
    return std::fmod(std::abs(std::floor(p.x) + std::floor(p.y) + std::floor(p.z)), 2.0);
  }
};

TexturePtr parse(TableReader& table) {
  return pattern_stands(table) ? std::make_shared<SolidChecker>(table) : nullptr;
}

}  // namespace

extern const TextureType solid_checker_type{
    .name = "solid_checker", .manual = manual, .keys = keys, .parse = parse};

}  // namespace eyeray::engine::textures
