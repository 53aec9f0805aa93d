#include <cmath>

#include "host/records/packer.hpp"
#include "host/textures/make.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

extern const TextureType checker_type;

namespace {

constexpr std::string_view manual = R"(A checkerboard in uv, for any color that may vary over a surface.
)";

constexpr Key keys[] = {
    {.name = "even",
     .type = KeyType::color,
     .doc = "Color of the check with a corner at the uv origin.",
     .min = 0},
    {.name = "odd", .type = KeyType::color, .doc = "Color of the neighbouring checks.", .min = 0},
    {.name = "size",
     .type = KeyType::scale2,
     .doc = "Size of a check in uv.",
     .fallback = "1",
     .min = 0,
     .above_min = true},
};

class Checker final : public Texture {
 public:
  Checker(const Vec3& even, const Vec3& odd, const Vec2& size) : even_(even), odd_(odd), size_(size) {}

  Vec3 at(const TextureContext& point) const override {
    const Vec2& uv = point.uv;
    const double check = std::floor(uv.x / size_.x) + std::floor(uv.y / size_.y);
    return std::fmod(std::fabs(check), 2.0) >= 0.5 ? odd_ : even_;
  }

  uint32_t pack(records::Packer& packer) const override {
    return packer.add(shader::Texture{.color = glm::vec3(even_),
                                      .kind = shader::TEXTURE_checker,
                                      .a = records::to_vec4(odd_),
                                      .b = shader::vec4(glm::vec2(1.0 / size_), 0, 0),
                                      .c = shader::uvec4(0)});
  }

 private:
  Vec3 even_, odd_;
  Vec2 size_;
};

TexturePtr parse(TableReader& table) {
  return make_checker(table.color("even"), table.color("odd"), table.scale2("size"));
}

}  // namespace

extern const TextureType checker_type{.name = "checker", .manual = manual, .keys = keys, .parse = parse};

TexturePtr make_checker(const Vec3& even, const Vec3& odd, const Vec2& size) {
  return std::make_shared<Checker>(even, odd, size);
}

}  // namespace eyeray::engine::textures
