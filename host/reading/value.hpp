// From a TOML value to a checked value of a Key's type. Private to this layer.
#pragma once

#include <toml++/toml.h>

#include <array>
#include <optional>
#include <variant>

#include "host/core/diagnostic_log.hpp"
#include "host/reading/formula_source.hpp"
#include "host/reading/image_source.hpp"
#include "host/reading/table_reader.hpp"
#include "host/reading/texture_type.hpp"

namespace eyeray::engine::reading {

// boolean bool; integer and choice int64_t; choice2 two of them; number double; string std::string; color
// Vec3; scale2, scale3 Vec2, Vec3.
using Value =
    std::variant<bool, int64_t, std::array<int64_t, 2>, double, std::string, Vec2, Vec3, std::vector<Vec2>,
                 std::vector<Vec3>, std::vector<Vec4>, std::vector<std::vector<Vec3>>, formula::FormulaText,
                 std::vector<formula::FormulaParameter>, TexturePtr, Mat4>;

// The sources of values beside TOML.
struct ValueSources {
  FormulaSource* formulas = nullptr;                  // loads the files of formulas; null: none may be named
  ImageSource* images = nullptr;                      // loads the images of textures; null: none may be named
  std::span<const TextureType* const> textures = {};  // the kinds, one of plain colors among them
};

// The value, or nothing, with an error in the log for each fault in it.
std::optional<Value> read_value(const Key& key, const toml::node& node, DiagnosticLog& log,
                                const ValueSources& sources);

// Some value of the key's type and range, for going on after an error.
Value stand_in(const Key& key, const ValueSources& sources);

}  // namespace eyeray::engine::reading
