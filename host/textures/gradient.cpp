#include <algorithm>
#include <cmath>

#include "host/textures/pattern.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

extern const TextureType gradient_type;

namespace {

constexpr std::string_view manual =
    R"(A ramp along x from 0 to 1 in each unit. It is defined in space and passes through the object.
)";

constexpr Key keys[] = {
    colors_key("[[0, 0], [1, 1]]"),
    pattern_transform_key,
};

class Gradient final : public Pattern {
 public:
  explicit Gradient(const TableReader& table) : Pattern(table, shader::TEXTURE_gradient) {}

 protected:
  double share(const Vec3& p) const override { return p.x - std::floor(p.x); }
};

TexturePtr parse(TableReader& table) {
  return pattern_stands(table) ? std::make_shared<Gradient>(table) : nullptr;
}

}  // namespace

extern const TextureType gradient_type{.name = "gradient", .manual = manual, .keys = keys, .parse = parse};

}  // namespace eyeray::engine::textures
