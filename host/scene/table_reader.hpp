// Strict reading of one table of a scene file. Each key is declared once, as a Key; from that one row come
// the type, range and default checks, "did you mean", the JSON Schema and the manual.
#pragma once

#include <array>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/core/vec.hpp"

namespace eyeray {

namespace formula {
struct FormulaText;  // formula/formula.hpp
struct FormulaParameter;
}  // namespace formula
class Texture;  // scene/texture.hpp
using TexturePtr = std::shared_ptr<const Texture>;
struct ImageTexture;  // scene/image_texture.hpp

enum class KeyType {
  boolean,
  integer,
  number,
  string,
  choice,        // a string out of Key::choices
  choice2,       // two of them [u, v], or one for both
  vec2,          // [x, y]
  vec3,          // [x, y, z]
  vec2_list,     // [[x, y], …]
  vec3_list,     // [[x, y, z], …]
  outlines,      // [[[x, y, z], …], …]
  formula,       // GLSL, best in """…"""
  formula_file,  // the name of a file of it
  parameters,    // { NAME = number or [2 to 4 numbers], … }
  color_map,     // [[t, color], …], t rising from 0 to 1 at most
  keyframes,     // [[frame, value], …], frames rising; checked by who reads them (loader/keyframes.hpp)
  color,         // [r, g, b], each ≥ 0, or one number for all three
  texture,       // a color, or a table of a kind of texture
  scale2,        // [u, v], or one number for both
  scale3,        // [x, y, z], or one number for all three
  transform,  // [ { translate = [x,y,z] }, { rotate = { axis = [x,y,z], degrees = a } }, { scale = number or
              // [x,y,z] },
              //   { matrix = [[4], [4], [4]] } ], applied in the order written
  rotation,   // { axis = [x, y, z], degrees = a }, of a transform
  matrix,     // [[4], [4], [4]], of a transform
};

struct Key {
  static constexpr double inf = std::numeric_limits<double>::infinity();

  std::string_view name;
  KeyType type;
  std::string_view doc;            // one line, with the unit
  std::string_view fallback = {};  // the default, as TOML; empty: the key must be given, unless `optional`
  double min = -inf;               // of every number in the value; NaN and infinities are always errors
  double max = inf;
  bool above_min = false;  // the minimum itself is out of range
  std::span<const std::string_view> choices = {};
  bool optional = false;       // may be absent without a default: ask has()
  bool below_max = false;      // the maximum itself is out of range
  std::string_view hint = {};  // of a choice: said of a value that is none and that nothing is near to
};

// What a value of this key is, for messages and the manual: "an integer from 1 to 65536", "a number above 0".
std::string describe(const Key& key);

class TableReader {
 public:
  // The readers of declared keys. Each value has been checked against its Key; after an error a valid
  // stand-in comes back, so that reading goes on and all errors are reported together. Asking for an
  // undeclared key is a CHECK.
  bool has(std::string_view key) const;  // written in the table (not defaulted)
  bool boolean(std::string_view key) const;
  int64_t integer(std::string_view key) const;
  double number(std::string_view key) const;
  std::string string(std::string_view key) const;
  int choice(std::string_view key) const;  // index in Key::choices
  std::array<int, 2> choice2(std::string_view key) const;
  Vec2 vec2(std::string_view key) const;
  Vec3 vec3(std::string_view key) const;
  std::vector<Vec2> vec2_list(std::string_view key) const;
  std::vector<Vec3> vec3_list(std::string_view key) const;
  std::vector<std::vector<Vec3>> outlines(std::string_view key) const;
  formula::FormulaText formula(std::string_view key) const;  // of formula and formula_file
  std::vector<formula::FormulaParameter> parameters(std::string_view key) const;
  Vec3 color(std::string_view key) const;
  std::vector<Vec4> color_map(std::string_view key) const;  // color, then where it is
  TexturePtr texture(std::string_view key) const;
  // `wanted` with the texels of the file that the key names; null where it cannot be had, which is an error
  // then.
  std::shared_ptr<const ImageTexture> load_image(std::string_view key, ImageTexture wanted);
  Vec2 scale2(std::string_view key) const;
  Vec3 scale3(std::string_view key) const;
  Mat4 transform(std::string_view key) const;

  // Adds an error at the key's value, or at the table where the key is absent; nothing when the value already
  // had one. `element`: of a list, [i], or of a list in it, [i, k], to which the error belongs.
  void error(std::string_view key, std::string message, std::initializer_list<size_t> element = {});
  // Adds a warning at the key's value, or at the table where the key is absent.
  void warning(std::string_view key, std::string message);
  // Adds what is wrong within the text of a formula.
  void error(const InputError& faults);
  // Whether the key's value, written or default, is right: false after an error in it, or where it is
  // missing.
  bool valid(std::string_view key) const;
  // Whether this table has had an error so far.
  bool failed() const;
  SourcePosition position() const;
  // Of the key's value, or of the table where the key is absent.
  SourcePosition position(std::string_view key) const;

  struct Table;  // the parsed TOML behind it; scene/table_reader.cpp
  explicit TableReader(std::unique_ptr<Table> table);
  ~TableReader();

 private:
  std::unique_ptr<Table> table_;
};

}  // namespace eyeray
