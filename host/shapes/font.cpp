#include "host/shapes/font.hpp"

#include <freetype/freetype.h>
#include <freetype/ftoutln.h>
#include <ft2build.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "host/core/error.hpp"

namespace eyeray::engine::shapes {

namespace {

// No letter of a real font is so large, in ems, or has so many corners.
constexpr double largest_letter = 100;
constexpr size_t most_corners = 16384;

[[noreturn]] void refuse(std::string_view why) {
  throw Error(ExitCode::bad_input, "{}", why);
}
constexpr std::string_view damaged = "it is damaged";

// Builds the polygons of an outline. FreeType calls the functions for each of its lines and curves.
struct Polygons {
  double em;
  std::vector<std::vector<Vec2>> outlines = {};
  size_t corners = 0;
  bool fits = true;

  Vec2 point(const FT_Vector* p) const { return Vec2(double(p->x), double(p->y)) / em; }
  void add(const Vec2& p) {
    auto& outline = outlines.back();
    if (!outline.empty() && outline.back() == p) return;
    outline.push_back(p);
    fits = fits && ++corners <= most_corners && std::max(std::fabs(p.x), std::fabs(p.y)) <= largest_letter;
  }
  // A Bézier curve, by so many chords that none is off it by more than the tolerance (Wang's formula).
  template <size_t N>
  void add_curve(const std::array<Vec2, N>& p) {
    double bend = 0;
    for (size_t i = 2; i < N; ++i) bend = std::max(bend, glm::length(p[i] - 2.0 * p[i - 1] + p[i - 2]));
    constexpr auto power = double(N - 1);
    const double chords = std::ceil(std::sqrt(power * (power - 1) / 8 * bend / font_tolerance));
    const int count = int(std::clamp(chords, 1.0, 256.0));
    for (int i = 1; i < count; ++i) {
      std::array<Vec2, N> at = p;
      const double s = double(i) / count;
      for (size_t order = N - 1; order > 0; --order)
        for (size_t k = 0; k < order; ++k) at[k] = glm::mix(at[k], at[k + 1], s);
      add(at[0]);
    }
    add(p[N - 1]);
  }
  Vec2 last() const { return outlines.back().back(); }

  static Polygons& of(void* user) { return *static_cast<Polygons*>(user); }
  int result() const { return fits && !outlines.empty() ? 0 : 1; }
};

int move_to(const FT_Vector* to, void* user) {
  Polygons& polygons = Polygons::of(user);
  polygons.outlines.emplace_back();
  polygons.add(polygons.point(to));
  return polygons.result();
}
int line_to(const FT_Vector* to, void* user) {
  Polygons& polygons = Polygons::of(user);
  polygons.add(polygons.point(to));
  return polygons.result();
}
int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
  Polygons& polygons = Polygons::of(user);
  polygons.add_curve<3>({polygons.last(), polygons.point(control), polygons.point(to)});
  return polygons.result();
}
int cubic_to(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* user) {
  Polygons& polygons = Polygons::of(user);
  polygons.add_curve<4>({polygons.last(), polygons.point(first), polygons.point(second), polygons.point(to)});
  return polygons.result();
}

// Other formats that FreeType reads have no outlines, or are compressed without a limit.
bool is_supported(std::string_view bytes) {
  using namespace std::string_view_literals;
  const std::string_view tag = bytes.substr(0, 4);
  return tag == "\0\1\0\0"sv || tag == "true"sv || tag == "OTTO"sv || tag == "ttcf"sv;
}

}  // namespace

struct Font::Face {
  std::shared_ptr<const std::string> bytes;  // FreeType reads them as long as the face lives
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  ~Face() {
    if (face) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }
  double em() const { return double(face->units_per_EM); }
};

Font::Font(std::shared_ptr<const std::string> bytes) : face_(std::make_unique<Face>()) {
  if (!is_supported(*bytes)) refuse("it is no TrueType or OpenType font (.ttf, .otf, .ttc)");
  face_->bytes = std::move(bytes);
  if (FT_Init_FreeType(&face_->library) != 0)
    throw Error(ExitCode::internal, "the library FreeType cannot be initialised");
  if (FT_New_Memory_Face(face_->library, reinterpret_cast<const FT_Byte*>(face_->bytes->data()),
                         FT_Long(face_->bytes->size()), 0, &face_->face) != 0)
    refuse(damaged);
  if (!FT_IS_SCALABLE(face_->face) || face_->face->units_per_EM == 0)
    refuse("its letters are pictures, not outlines");
  if (FT_Select_Charmap(face_->face, FT_ENCODING_UNICODE) != 0)
    refuse("it does not state which letters of Unicode it has");
}

Font::~Font() = default;

Glyph Font::glyph(uint32_t code_point) const {
  Glyph glyph;
  glyph.index = FT_Get_Char_Index(face_->face, code_point);
  if (FT_Load_Glyph(face_->face, glyph.index, FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) !=
          0 ||
      face_->face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
    refuse(damaged);
  FT_Outline& outline = face_->face->glyph->outline;
  glyph.advance = double(face_->face->glyph->metrics.horiAdvance) / face_->em();
  constexpr FT_Outline_Funcs functions{move_to, line_to, conic_to, cubic_to, 0, 0};
  Polygons polygons{.em = face_->em()};
  if (FT_Outline_Decompose(&outline, &functions, &polygons) != 0 || !polygons.fits ||
      !(std::fabs(glyph.advance) <= largest_letter))
    refuse(damaged);
  for (auto& polygon : polygons.outlines) {
    while (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
    if (polygon.size() > 2) glyph.outlines.push_back(std::move(polygon));
  }
  return glyph;
}

double Font::kerning(const Glyph& left, const Glyph& right) const {
  FT_Vector move{0, 0};
  if (left.index == 0 || right.index == 0 || !FT_HAS_KERNING(face_->face)) return 0;
  if (FT_Get_Kerning(face_->face, left.index, right.index, FT_KERNING_UNSCALED, &move) != 0) return 0;
  return std::clamp(double(move.x) / face_->em(), -largest_letter, largest_letter);
}

double Font::line_height() const {
  const double height = double(face_->face->height) / face_->em();
  return height > 0 ? height : 1.2;
}

}  // namespace eyeray::engine::shapes
