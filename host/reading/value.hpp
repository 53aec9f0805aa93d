// Turns a TOML value into a checked value of a Key's type. Private to this layer.
#pragma once

#include <toml++/toml.h>

#include <array>
#include <optional>
#include <variant>

#include "host/core/diagnostic_log.hpp"
#include "host/reading/font_source.hpp"
#include "host/reading/formula_source.hpp"
#include "host/reading/image_source.hpp"
#include "host/reading/number_expression.hpp"
#include "host/reading/table_reader.hpp"
#include "host/reading/texture_type.hpp"

namespace eyeray::engine::reading {

// A checked value. The KeyTypes boolean, number, string and color give bool, double, std::string and Vec3.
// integer and choice give int64_t, choice2 two of these, and scale2 and scale3 Vec2 and Vec3.
using Value = std::variant<bool, int64_t, std::array<int64_t, 2>, double, std::string, Vec2, Vec3,
                           std::vector<Vec2>, std::vector<Vec3>, std::vector<Vec4>,
                           std::vector<std::vector<Vec3>>, std::vector<std::vector<double>>,
                           formula::FormulaText, std::vector<formula::FormulaParameter>, TexturePtr, Mat4>;

// The sources of values that are not in the TOML itself.
struct ValueSources {
  FormulaSource* formulas = nullptr;                  // loads the files of formulas; null: none may be named
  ImageSource* images = nullptr;                      // loads the images of textures; null: none may be named
  FontSource* fonts = nullptr;                        // loads the files of fonts; null: none may be named
  std::span<const TextureType* const> textures = {};  // the kinds, among them that of plain colors
  const Variables* variables = nullptr;  // variables of expressions; null: numbers cannot be expressions
};

// The texture of one color.
TexturePtr plain_texture(const Vec3& color, const ValueSources& sources);

// The value; or nothing, with an error in the log for each fault in the value.
std::optional<Value> read_value(const Key& key, const toml::node& node, DiagnosticLog& log,
                                const ValueSources& sources);

// A value of the key's type and range, with which reading goes on after an error.
Value stand_in(const Key& key, const ValueSources& sources);

}  // namespace eyeray::engine::reading
