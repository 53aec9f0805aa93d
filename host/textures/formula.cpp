#include "host/formula/formula.hpp"

#include "host/reading/formula_reader.hpp"
#include "host/records/packer.hpp"
#include "host/textures/make.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

extern const TextureType formula_type;

namespace {

constexpr std::string_view manual =
    R"(A color that a user-defined function computes from uv, for any color that may vary over a surface.
[formulas.md](formulas.md) describes the GLSL that it may use.

```toml
[[material]]
name = "rings"
type = "phong"

[material.diffuse.formula]
code = """
vec3 color(vec2 uv) {
  float wave = 0.5 + 0.5 * cos(6.2832 * rings * length(uv - 0.5));
  return mix(vec3(0.05, 0.1, 0.3), vec3(0.9, 0.8, 0.5), wave);
}
"""
parameters = { rings = 8 }
```

The text of the function is in `code`, or in a separate file, `file = "rings.glsl"`. The entries of
`parameters` are constants of the function, by name. A number becomes a `float`, a list of two to four numbers
a `vec2` … `vec4`. The function returns linear RGB. Values below 0 and above 1 are cut off, and a value that
is not a number becomes 0. For an alpha, the first component counts.
)";

constexpr Key keys[] = {
    {.name = "code",
     .type = KeyType::formula,
     .doc = "The function `vec3 color(vec2 uv)` and the functions that it calls.",
     .optional = true},
    reading::formula_file_key,
    reading::parameters_key,
    {.name = "tint", .type = KeyType::color, .doc = "Factor for the function's color.", .fallback = "1"},
};

class FormulaTexture final : public Texture {
 public:
  FormulaTexture(std::shared_ptr<const formula::Formula> formula, const Vec3& tint)
      : formula_(std::move(formula)), tint_(tint) {}

  Vec3 at(const TextureContext& point) const override {
    const auto color = formula_->color(std::array{point.uv.x, point.uv.y});
    Vec3 shares(0.0);
    for (int i = 0; i < 3; ++i)
      if (color[size_t(i)] > 0) shares[i] = std::min(color[size_t(i)], 1.0);
    return tint_ * shares;
  }

  uint32_t pack(records::Packer& packer) const override {
    return packer.add(shader::Texture{.color = glm::vec3(tint_),
                                      .kind = shader::TEXTURE_formula,
                                      .a = shader::vec4(0),
                                      .b = shader::vec4(0),
                                      .c = shader::uvec4(packer.add_formula(formula_), 0, 0, 0)});
  }

 private:
  std::shared_ptr<const formula::Formula> formula_;
  Vec3 tint_;
};

TexturePtr parse(TableReader& table) {
  constexpr std::string_view owner = "{ formula = … }";
  if (!has_one_source(table, {"code", "file"}, owner)) return nullptr;
  if (table.failed()) return nullptr;
  auto formula = read_formula(table, owner, formula::FormulaKind::color);
  return formula ? make_formula(std::move(formula), table.color("tint")) : nullptr;
}

}  // namespace

extern const TextureType formula_type{.name = "formula", .manual = manual, .keys = keys, .parse = parse};

TexturePtr make_formula(std::shared_ptr<const formula::Formula> formula, const Vec3& tint) {
  return std::make_shared<FormulaTexture>(std::move(formula), tint);
}

}  // namespace eyeray::engine::textures
