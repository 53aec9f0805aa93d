// Reads one table of a scene file, strictly.
#pragma once

#include <array>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/core/vec.hpp"
#include "host/reading/key.hpp"
#include "host/scene/texture.hpp"

namespace eyeray::engine {
struct ImageTexture;  // scene/image_texture.hpp
}
namespace eyeray::engine::formula {
struct FormulaText;  // formula/formula.hpp
struct FormulaParameter;
}  // namespace eyeray::engine::formula

namespace eyeray::engine::reading {

class TableReader {
 public:
  // The readers of declared keys. Each value has been checked by its Key. After an error they return a valid
  // stand-in, so that reading goes on and all errors are reported together. A CHECK stops the program if an
  // undeclared key is read.
  bool has(std::string_view key) const;  // true if the key is written, not defaulted
  bool boolean(std::string_view key) const;
  int64_t integer(std::string_view key) const;
  double number(std::string_view key) const;
  bool is_word(std::string_view key) const;  // true if a number's key has its word instead, Key::word
  std::string string(std::string_view key) const;
  int choice(std::string_view key) const;  // index in Key::choices
  std::array<int, 2> choice2(std::string_view key) const;
  Vec2 vec2(std::string_view key) const;
  Vec3 vec3(std::string_view key) const;
  std::vector<Vec2> vec2_list(std::string_view key) const;
  std::vector<Vec3> vec3_list(std::string_view key) const;
  std::vector<std::vector<Vec3>> outlines(std::string_view key) const;
  std::vector<std::vector<double>> rows(std::string_view key) const;
  formula::FormulaText formula(std::string_view key) const;  // for KeyType::formula and formula_file
  std::vector<formula::FormulaParameter> parameters(std::string_view key) const;
  Vec3 color(std::string_view key) const;
  std::vector<Vec4> color_map(std::string_view key) const;  // r, g, b, and the color's position t
  TexturePtr texture(std::string_view key) const;
  // `wanted` with the texels of the file that the key names; null, with an error, if they cannot be had.
  std::shared_ptr<const ImageTexture> load_image(std::string_view key, ImageTexture wanted);
  // The bytes of the font file that the key names; null, with an error, if they cannot be had.
  std::shared_ptr<const std::string> load_font(std::string_view key);
  Vec2 scale2(std::string_view key) const;
  Vec3 scale3(std::string_view key) const;
  Mat4 transform(std::string_view key) const;

  // Adds an error at the key's value, or at the table if the key is absent. Adds nothing if the value already
  // had an error. `element`: the element of a list that is wrong, [i], or that of a list in the list, [i, k].
  void error(std::string_view key, std::string message, std::initializer_list<size_t> element = {});
  // Adds a warning at the key's value, or at the table if the key is absent.
  void warning(std::string_view key, std::string message);
  // Adds a warning about a formula of the table, at its position.
  void warning(const SourcePosition& position, std::string message);
  // Adds the faults within the text of a formula.
  void error(const InputError& faults);
  // True if the key's value, written or default, is valid. False after an error in the value, or if there is
  // no value.
  bool valid(std::string_view key) const;
  // True if this table has had an error so far.
  bool failed() const;
  SourcePosition position() const;
  // The position of the key's value, or of the table if the key is absent.
  SourcePosition position(std::string_view key) const;

  struct Table;  // the parsed TOML; defined in reading/table_reader.cpp
  explicit TableReader(std::unique_ptr<Table> table);
  ~TableReader();

 private:
  std::unique_ptr<Table> table_;
};

}  // namespace eyeray::engine::reading
