// Outlines of letters, from the files of scalable fonts. FreeType reads the files.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine::shapes {

// A letter. Lengths are in ems, from the start of its baseline; y is up.
struct Glyph {
  uint32_t index = 0;  // 0 if the font has no such letter
  double advance = 0;  // to the start of the next letter
  // Closed polygons that differ from the font's curves by at most `font_tolerance`.
  std::vector<std::vector<Vec2>> outlines;
};

inline constexpr double font_tolerance = 0.0005;

// One thread at a time may use a font.
class Font {
 public:
  // `bytes`: the file. Error (bad_input), without the file's name, if it is no TrueType or OpenType font with
  // outlines, or if it is damaged.
  explicit Font(std::shared_ptr<const std::string> bytes);
  ~Font();

  // The letter of a code point. Error (bad_input) as above.
  Glyph glyph(uint32_t code_point) const;
  // The distance by which the letter `right` moves behind `left`, by the font's table `kern`.
  double kerning(const Glyph& left, const Glyph& right) const;
  // The distance between baselines.
  double line_height() const;

 private:
  struct Face;
  std::unique_ptr<Face> face_;
};

}  // namespace eyeray::engine::shapes
