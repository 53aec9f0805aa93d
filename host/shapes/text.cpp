#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/core/error.hpp"
#include "host/shapes/font.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/planar_region.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(Letters as bodies, from a font in a file. The front of the text is the plane z = `depth`, and its back is z = 0.
The baseline of the first line is the x axis: `align` puts the start, the middle or the end of each line at x = 0.

```
[[text]]
text = "eyeray"
font = "fonts/eyeray.ttf"
size = 1
depth = 0.2
align = "center"
material = "wall"
```

A line break in `text` starts the next line, at the distance that the font states. Letters are set from left to
right, with the kerning of the font's table `kern`; ligatures, and the tables of OpenType that replace or move letters,
are not used. A letter that the font lacks is left out, and a warning counts such letters. `transform` may be any
invertible affine map.

A text is one [prism](#prism): it may be of glass, and it may be part of a [CSG](#csg) object. A ray that passes through
its box tests all edges of all letters. Put a long text in several tables. Letters must not overlap or touch,
as those of connected handwriting do.

**Outlines.** The font's curves become chords that are off them by at most 1/2000 of `size`. A text has at most 16384 of
them.

**uv.** On the front u and v are x and y. On the back u is negated. On a wall u is the length along the outline, and v
the distance from the back.

**Source.** FreeType reads the fonts: TrueType and OpenType, in one file of up to 32 MiB. It takes the first font of a
collection. Wang's formula for the number of chords is in Goldman: Pyramid Algorithms, 2003.
)";

constexpr std::string_view alignments[] = {"left", "center", "right"};

constexpr Key keys[] = {
    {.name = "text", .type = KeyType::string, .doc = "The letters, in UTF-8."},
    {.name = "font",
     .type = KeyType::string,
     .doc = "Name of a file with the font, relative to the scene file that contains this key."},
    {.name = "size",
     .type = KeyType::number,
     .doc = "The font's em: about the distance of two lines.",
     .fallback = "1",
     .min = min_radius,
     .max = max_coordinate},
    {.name = "depth",
     .type = KeyType::number,
     .doc = "The thickness of the letters.",
     .min = min_radius,
     .max = max_coordinate},
    {.name = "align",
     .type = KeyType::choice,
     .doc = "The point of each line that is at x = 0.",
     .fallback = "\"left\"",
     .choices = alignments},
};

constexpr size_t most_letters = 4096;

// The code points of a text in UTF-8. A byte that belongs to none becomes U+FFFD.
std::vector<uint32_t> code_points(std::string_view text) {
  std::vector<uint32_t> points;
  for (size_t i = 0; i < text.size();) {
    const auto first = uint8_t(text[i++]);
    const size_t more = first < 0x80 ? 0 : first < 0xc0 ? 4 : first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
    uint32_t point = more == 0 ? first : first & (0x3fu >> more);
    size_t read = 0;
    while (read < more && i < text.size() && (uint8_t(text[i]) & 0xc0) == 0x80) {
      point = point << 6 | (uint8_t(text[i++]) & 0x3fu);
      ++read;
    }
    points.push_back(more < 4 && read == more ? point : 0xfffd);
  }
  return points;
}

// A code point as people see it.
std::string shown(uint32_t point) {
  return point > 0x20 && point < 0x7f ? fmt::format("\"{}\"", char(point)) : fmt::format("U+{:04X}", point);
}

// The letters' outlines, laid out in ems.
struct Layout {
  std::vector<std::vector<Vec2>> outlines;
  std::vector<uint32_t> letters;  // the code point of each outline
  size_t missing = 0;             // letters that the font lacks …
  uint32_t first_missing = 0;     // … and the first of them
};

Layout lay_out(const Font& font, const std::vector<uint32_t>& points, int align) {
  Layout layout;
  size_t line_start = 0;
  double x = 0, y = 0;
  Glyph before;
  const auto end_line = [&] {
    const double shift = align == 0 ? 0 : align == 1 ? -x / 2 : -x;
    for (; line_start < layout.outlines.size(); ++line_start)
      for (Vec2& corner : layout.outlines[line_start]) corner += Vec2(shift, y);
    x = 0;
    y -= font.line_height();
    before = {};
  };
  for (const uint32_t point : points) {
    if (point == '\n') {
      end_line();
      continue;
    }
    if (point == '\r') continue;
    Glyph glyph = font.glyph(point == '\t' ? ' ' : point);
    if (glyph.index == 0) {
      if (layout.missing++ == 0) layout.first_missing = point;
      continue;
    }
    x += font.kerning(before, glyph);
    for (auto& outline : glyph.outlines) {
      for (Vec2& corner : outline) corner.x += x;
      layout.outlines.push_back(std::move(outline));
      layout.letters.push_back(point);
    }
    x += glyph.advance;
    before = std::move(glyph);
  }
  end_line();
  return layout;
}

// The region of the letters, `size` large, in the plane z = 0. Nothing after an error.
std::optional<PlanarRegion> region_of(const Layout& layout, double size, TableReader& table) {
  if (layout.outlines.empty()) {
    table.error("text", "the text has no visible letter");
    return std::nullopt;
  }
  size_t corners = 0;
  PlanarRegion region;
  for (size_t k = 0; k < layout.outlines.size(); ++k) {
    Outline outline;
    for (const Vec2& corner : layout.outlines[k]) outline.emplace_back(corner * size, 0.0);
    corners += outline.size();
    if (k == 0)
      region.outer = std::move(outline);
    else
      region.holes.push_back(std::move(outline));
  }
  if (corners > most_outline_vertices) {
    table.error("text", fmt::format("the outlines of the text have {} edges, and at most {} are possible: "
                                    "put the text in several tables",
                                    corners, most_outline_vertices));
    return std::nullopt;
  }
  const auto fault = find_fault(region, false);
  if (!fault) return region;
  const std::string letter = shown(layout.letters[fault->outline]),
                    other = shown(layout.letters[fault->other]);
  if (letter != other)
    table.error("text", fmt::format("the letters {} and {} overlap or touch: put them in tables of their own",
                                    other, letter));
  else
    table.error("text", fmt::format("the outlines of the letter {} cross, touch or have no area: use another "
                                    "font, or leave the letter out",
                                    letter));
  return std::nullopt;
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const std::vector<uint32_t> points = code_points(table.string("text"));
  if (table.failed()) return nullptr;
  const auto bytes = table.load_font("font");
  if (!bytes) return nullptr;
  if (points.size() > most_letters) {
    table.error("text", fmt::format("the text has {} letters, and at most {} are possible: put it in several "
                                    "tables",
                                    points.size(), most_letters));
    return nullptr;
  }
  const double size = table.number("size");
  std::optional<PlanarRegion> region;
  try {
    const Layout layout = lay_out(Font(bytes), points, table.choice("align"));
    if (layout.missing > 0)
      table.warning("text",
                    fmt::format("{} of the text's {} letters {} left out, because the font has no {}{}",
                                layout.missing, points.size(), layout.missing == 1 ? "is" : "are",
                                shown(layout.first_missing), layout.missing == 1 ? "" : " …"));
    region = region_of(layout, size, table);
  } catch (const Error& unusable) {
    table.error("font", fmt::format("the font cannot be used: {}", unusable.what()));
  }
  if (!region) return nullptr;
  const Vec3 extrusion(0, 0, table.number("depth"));
  Bounds box;
  for (const Vec3& corner : region->outer) box.include(corner);
  for (const Outline& outline : region->holes)
    for (const Vec3& corner : outline) box.include(corner);
  const Vec3 half = (box.max - box.min) * 0.5;
  Mat4 map(1.0);
  map[0] *= half.x;
  map[1] *= half.y;
  map[2] *= extrusion.z / 2;
  map[3] = Vec4((box.min + box.max) * 0.5, 1);
  if (out_of_range(table, transform * map)) return nullptr;
  return make_prism(*region, extrusion, transform, Vec3(0));
}

}  // namespace

extern const ShapeType text_type{.name = "text", .manual = manual, .keys = keys, .parse = parse};

}  // namespace eyeray::engine::shapes
