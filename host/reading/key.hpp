// The keys of a table of a scene file. Each key is declared once, as a Key. That declaration drives the
// checks of type, range and default, "did you mean", the JSON Schema and the manual.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace eyeray::engine::reading {

enum class KeyType {
  boolean,
  integer,
  number,
  string,
  choice,        // a string out of Key::choices
  choice2,       // two such strings [u, v], or one for both
  vec2,          // [x, y]
  vec3,          // [x, y, z]
  vec2_list,     // [[x, y], …]
  vec3_list,     // [[x, y, z], …]
  outlines,      // [[[x, y, z], …], …]
  rows,          // [[number, …], …]; Key::choices names the numbers of a row
  formula,       // GLSL, best in """…"""
  formula_file,  // the name of a file of GLSL
  parameters,    // { NAME = number or [2 to 4 numbers], … }
  color_map,     // [[t, color], …], t rising from 0 to 1 at most
  keyframes,     // [[frame, value], …], frames rising; checked by value_between (loader/keyframes.hpp)
  color,         // [r, g, b], each ≥ 0, or one number for all three
  texture,       // a color, or a table of a kind of texture
  scale2,        // [u, v], or one number for both
  scale3,        // [x, y, z], or one number for all three
  transform,  // [ { translate = [x,y,z] }, { rotate = { axis = [x,y,z], degrees = a } }, { scale = number or
              // [x,y,z] },
              //   { matrix = [[4], [4], [4]] } ], applied in the order written
  rotation,   // { axis = [x, y, z], degrees = a }, a step of a transform
  matrix,     // [[4], [4], [4]], a step of a transform
};

struct Key {
  static constexpr double inf = std::numeric_limits<double>::infinity();

  std::string_view name;
  KeyType type;
  std::string_view doc;            // one line, with the unit
  std::string_view fallback = {};  // the default, as TOML; empty: the key must be given, unless `optional`
  double min = -inf;               // least number in the value; NaN and infinities are always errors
  double max = inf;
  bool above_min = false;  // the minimum itself is out of range
  std::span<const std::string_view> choices = {};
  bool optional = false;       // may be absent though it has no default: check has()
  bool below_max = false;      // the maximum itself is out of range
  std::string_view word = {};  // a string that the key of a number takes too, such as "auto"
  std::string_view hint = {};  // ends the error for a value that is no choice, and similar to none
};

// Describes a value of this key in messages and the manual: "an integer from 1 to 65536", "a number above 0".
std::string describe(const Key& key);

}  // namespace eyeray::engine::reading
