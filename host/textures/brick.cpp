#include <algorithm>
#include <cmath>

#include "host/textures/pattern.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

extern const TextureType brick_type;

namespace {

constexpr std::string_view manual =
    R"(Bricks along x. Each layer is shifted by half a brick against the layer below. The mortar has the first color,
and the bricks have the last. Faces exactly where mortar begins are inside it: move the pattern a little.
)";

constexpr Key keys[] = {
    colors_key("[[0, 0.6], [1, [0.45, 0.13, 0.09]]]"),
    {.name = "size",
     .type = KeyType::scale3,
     .doc = "Size of a brick, including its mortar.",
     .fallback = "[0.8, 0.3, 0.45]",
     .min = 0,
     .above_min = true},
    {.name = "mortar",
     .type = KeyType::number,
     .doc = "Thickness of the mortar.",
     .fallback = "0.05",
     .min = 0},
    pattern_transform_key,
};

class Brick final : public Pattern {
 public:
  explicit Brick(const TableReader& table)
      : Pattern(table, shader::TEXTURE_brick, Vec4(table.scale3("size"), table.number("mortar"))),
        size_(table.scale3("size")),
        mortar_(table.number("mortar")) {}

 protected:
  double share(const Vec3& p) const override {
    const double layer = std::floor(p.y / size_.y), off = std::fmod(std::abs(layer), 2.0) / 2;
    const Vec3 turned = p / size_ + Vec3(off, 0, off), within = (turned - glm::floor(turned)) * size_;
    return std::min({within.x, within.y, within.z}) < mortar_ ? 0 : 1;
  }

 private:
  Vec3 size_;
  double mortar_;
};

TexturePtr parse(TableReader& table) {
  return pattern_stands(table) ? std::make_shared<Brick>(table) : nullptr;
}

}  // namespace

extern const TextureType brick_type{.name = "brick", .manual = manual, .keys = keys, .parse = parse};

}  // namespace eyeray::engine::textures
