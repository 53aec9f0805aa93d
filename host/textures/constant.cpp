#include "host/records/packer.hpp"
#include "host/textures/make.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

extern const TextureType constant_type;

namespace {

constexpr std::string_view manual =
    R"(One color, in linear RGB. A single number stands for all three components.
)";

class Constant final : public Texture {
 public:
  explicit Constant(const Vec3& color) : color_(color) {}

  Vec3 at(const TextureContext&) const override { return color_; }
  std::optional<Vec3> constant() const override { return color_; }

  uint32_t pack(records::Packer& packer) const override {
    return packer.add(shader::Texture{.color = glm::vec3(color_),
                                      .kind = shader::TEXTURE_constant,
                                      .a = shader::vec4(0),
                                      .b = shader::vec4(0),
                                      .c = shader::uvec4(0)});
  }

 private:
  Vec3 color_;
};

}  // namespace

extern const TextureType constant_type{.name = "constant", .manual = manual, .of_color = make_constant};

TexturePtr make_constant(const Vec3& color) {
  return std::make_shared<Constant>(color);
}

}  // namespace eyeray::engine::textures
