// Reads OFF as text: polygons, and the colours, normals and uv that its prefixes announce. A file without
// faces is one of points. Source: Geomview Manual, The Geometry Center: OFF Files.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/core/free_memory.hpp"
#include "host/importers/cloud_builder.hpp"
#include "host/importers/file_polygons.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/malformed.hpp"
#include "host/importers/mesh_builder.hpp"
#include "host/importers/number_lines.hpp"

namespace eyeray::engine::importers {

namespace {

// The colour of faces that have none, in a file where others have one: that of plain_material().
constexpr double face_gray = 0.75;

// The values of a vertex beside its position.
struct OffLayout {
  bool uv = false, colors = false, normals = false;

  size_t fewest() const { return 3 + 3 * size_t(normals) + 3 * size_t(colors) + 2 * size_t(uv); }
};

// The colours of a file as they are written, and the number of full brightness among them.
class OffColors {
 public:
  // `rgb`: three or four numbers.
  void add(const double* rgb, size_t size) {
    written_.emplace_back(rgb[0], rgb[1], rgb[2]);
    const double alpha = size > 3 ? rgb[3] : std::numeric_limits<double>::infinity();
    alphas_.push_back(alpha);
    for (size_t i = 0; i < size; ++i) above_one_ = above_one_ || rgb[i] > 1;
    any_ = true;
  }
  // The colour of an element that has none.
  void add_none() {
    written_.emplace_back(-1.0);
    alphas_.push_back(std::numeric_limits<double>::infinity());
  }

  // Linear RGB, one an element; empty if no element has a colour. `rest`: that of elements without one.
  std::vector<Vec3> linear(const Vec3& rest) const {
    std::vector<Vec3> all;
    if (!any_) return all;
    all.reserve(written_.size());
    for (const Vec3& rgb : written_)
      all.push_back(rgb == Vec3(-1.0) ? rest : color_from_display(rgb / brightest()));
    return all;
  }
  // The number of colours with an alpha below 1.
  size_t transparent() const {
    size_t count = 0;
    for (const double alpha : alphas_) count += alpha < brightest();
    return count;
  }

 private:
  double brightest() const { return above_one_ ? 255 : 1; }

  std::vector<Vec3> written_;
  std::vector<double> alphas_;  // one a colour; infinite if it has none
  bool any_ = false, above_one_ = false;
};

class OffReader {
 public:
  explicit OffReader(const MeshFile& file) : lines_(file.bytes, file.name) {}

  void read() {
    if (!lines_.next()) lines_.fail("the file is empty");
    read_header();
    for (size_t i = 0; i < count_of_vertices_; ++i) {
      take_line("vertices", i, count_of_vertices_);
      read_vertex();
    }
    for (size_t i = 0; i < count_of_faces_; ++i) {
      take_line("faces", i, count_of_faces_);
      read_face();
    }
  }

  VertexPool vertices;
  FilePolygons polygons;
  OffColors colors, face_colors;
  size_t left_out = 0;        // numbers of vertices that the header does not announce
  size_t unknown_colors = 0;  // faces whose colour is none of three or four numbers

 private:
  void read_header();
  void read_layout(std::string_view keyword);
  void read_vertex();
  void read_face();
  uint32_t whole(double number, const char* what) const {
    if (!(number >= 0 && number < no_index && number == std::floor(number)))
      lines_.fail(fmt::format("{} is a whole number from 0 to 4294967294", what));
    return static_cast<uint32_t>(number);
  }
  void take_line(const char* what, size_t i, size_t stated) {
    if (!lines_.next())
      lines_.fail(fmt::format("the file ends too early: it states {} {}, but has {}", stated, what, i));
    lines_.read(numbers_, std::numeric_limits<size_t>::max());
  }

  NumberLines lines_;
  OffLayout layout_;
  size_t count_of_vertices_ = 0, count_of_faces_ = 0;
  std::vector<double> numbers_;  // the current line's
};

// Reads the keyword, which may be missing, and the counts of vertices, faces and edges, which may follow on
// the same line.
void OffReader::read_header() {
  const std::string_view line = lines_.line();
  const bool has_keyword = line.substr(0, line.find_first_of(" \t")).ends_with("OFF");
  if (has_keyword || !lines_.has_number()) {
    read_layout(lines_.word());
    lines_.skip_word("ASCII");
    if (lines_.skip_word("BINARY"))
      lines_.fail("it is a binary OFF: save it as text, the only form that eyeray reads");
  }
  constexpr size_t counts = 3;
  lines_.read(numbers_, counts);
  if (numbers_.empty()) {
    if (!lines_.next()) lines_.fail("the file ends before the numbers of its vertices and faces");
    lines_.read(numbers_, counts);
  }
  if (numbers_.size() < 2) lines_.fail("here must be the numbers of vertices, faces and edges");
  count_of_vertices_ = whole(numbers_[0], "the number of vertices");
  count_of_faces_ = whole(numbers_[1], "the number of faces");
}

void OffReader::read_layout(std::string_view keyword) {
  std::string_view rest = keyword;
  const auto take = [&](std::string_view prefix, bool& has) {
    if (has || !rest.starts_with(prefix)) return false;
    rest.remove_prefix(prefix.size());
    return has = true;
  };
  while (take("ST", layout_.uv) || take("C", layout_.colors) || take("N", layout_.normals)) continue;
  if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF")
    lines_.fail("its vertices have more than three coordinates, which is not supported");
  if (rest != "OFF")
    lines_.fail("this is not an OFF file: it begins with OFF, and before that perhaps ST, C and N");
}

// Reads x y z, then the values that the header announces: a normal, a colour of three or four numbers, uv.
void OffReader::read_vertex() {
  const size_t fewest = layout_.fewest();
  if (numbers_.size() < fewest)
    lines_.fail(fmt::format("a vertex of this file has {} numbers at least, and this line has {}", fewest,
                            numbers_.size()));
  const double* next = numbers_.data();
  vertices.positions.emplace_back(next[0], next[1], next[2]);
  next += 3;
  if (layout_.normals) {
    vertices.normals.emplace_back(next[0], next[1], next[2]);
    next += 3;
  }
  const bool has_alpha = layout_.colors && numbers_.size() > fewest;
  if (layout_.colors) {
    colors.add(next, has_alpha ? 4 : 3);
    next += has_alpha ? 4 : 3;
  }
  if (layout_.uv) vertices.uv.emplace_back(next[0], next[1]);
  left_out += numbers_.size() - fewest - size_t(has_alpha);
}

// Reads the number of corners, the corners, and perhaps a colour.
void OffReader::read_face() {
  const size_t corners = numbers_.empty() ? 0 : whole(numbers_[0], "the number of a face's corners");
  if (numbers_.empty() || numbers_.size() - 1 < corners)
    lines_.fail(fmt::format("a face of {} corners needs as many vertices, and this line has {}", corners,
                            numbers_.empty() ? 0 : numbers_.size() - 1));
  for (size_t i = 1; i <= corners; ++i) {
    const uint32_t vertex = whole(numbers_[i], "the number of a vertex");
    if (vertex >= vertices.positions.size())
      lines_.fail(fmt::format("there is no vertex {}: the file has {}, counted from 0", vertex,
                              vertices.positions.size()));
    polygons.corners.push_back(vertex);
  }
  polygons.sizes.push_back(static_cast<uint32_t>(corners));
  const size_t rest = numbers_.size() - 1 - corners;
  if (rest == 3 || rest == 4)
    face_colors.add(&numbers_[1 + corners], rest);
  else
    face_colors.add_none();
  unknown_colors += rest != 0 && rest != 3 && rest != 4;
}

}  // namespace

ImportedScene import_off(MeshFile& file) {
  ImportedScene scene;
  OffReader reader(file);
  reader.read();
  free_memory(file.bytes);  // the mesh needs the memory
  VertexPool& vertices = reader.vertices;
  vertices.colors = reader.colors.linear(Vec3(1));
  const auto warn = [&](size_t count, const char* what) {
    if (count > 0) scene.warnings.push_back(fmt::format("{} {}", count, what));
  };
  warn(reader.left_out, "numbers of its vertices were left out: the first line does not announce them");
  warn(reader.unknown_colors,
       "of its faces have a color of neither three nor four numbers, which was left out");
  warn(reader.colors.transparent() + reader.face_colors.transparent(),
       "of its colors are transparent, which was left out: give the mesh a `material` with `alpha`");
  if (reader.polygons.sizes.empty()) {
    if (file.options.point_shape == PointShape::sphere)
      warn(vertices.normals.size(), "normals of its points were left out");
    if (auto cloud = build_cloud({file.name, std::move(vertices.positions), std::move(vertices.colors),
                                  std::move(vertices.normals)},
                                 file.options, scene.warnings))
      scene.clouds.push_back({std::move(cloud)});
    return scene;
  }
  reader.polygons.colors = reader.face_colors.linear(Vec3(face_gray));
  add_values_of_faces(reader.polygons, vertices, scene.warnings);
  MeshCounts counts;
  const std::vector<RawTriangles> lists = triangulate(reader.polygons, vertices, 0, false, counts, file.name);
  reader.polygons = {};
  scene.instances.push_back({0, Mat4(1.0), -1, {}});
  scene.meshes.push_back(
      MeshBuilder(vertices, counts).build(lists[0], file.options.smooth.value_or(default_smooth)));
  counts.report(scene.warnings);
  return scene;
}

}  // namespace eyeray::engine::importers
