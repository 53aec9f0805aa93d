#include <algorithm>
#include <cmath>

#include "host/textures/pattern.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

extern const TextureType cells_type;

namespace {

constexpr std::string_view manual =
    R"(Distance to the nearest point of a random set that has one point in each cube of side 1 (Worley 1996).
)";

constexpr Key keys[] = {
    colors_key("[[0, 0], [1, 1]]"),
    pattern_transform_key,
};

class Cells final : public Pattern {
 public:
  explicit Cells(const TableReader& table) : Pattern(table, shader::TEXTURE_cells) {}

 protected:
  double share(const Vec3& p) const override {
    double nearest = 1;
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const Vec3 cell = glm::floor(p) + Vec3(x, y, z);
          const uint32_t first = cell_hash(cell), second = next_hash(first), third = next_hash(second);
          const Vec3 point(double(first >> 8), double(second >> 8), double(third >> 8));
          nearest = std::min(nearest, glm::distance(cell + point * 0x1p-24, p));
        }
      }
    }
    return nearest;
  }
};

TexturePtr parse(TableReader& table) {
  return pattern_stands(table) ? std::make_shared<Cells>(table) : nullptr;
}

}  // namespace

extern const TextureType cells_type{.name = "cells", .manual = manual, .keys = keys, .parse = parse};

}  // namespace eyeray::engine::textures
