// Wavefront OBJ: polygons, one mesh a material. This file reads the statements of geometry; tinyobjloader
// reads those of materials. It takes `nan`, `1,5` and any other malformed number as 0, and does not report
// its position. Source: Wavefront: Advanced Visualizer Manual, appendix B1.
#include <array>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>

#include "host/core/free_memory.hpp"
#include "host/importers/cloud_builder.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/line_builder.hpp"
#include "host/importers/malformed.hpp"
#include "host/importers/mesh_builder.hpp"
#include "host/importers/obj_materials.hpp"
#include "host/importers/obj_text.hpp"
#include "host/importers/polygon.hpp"

namespace eyeray::engine::importers {

namespace {

struct Corner {
  uint32_t position;
  uint32_t uv = no_index;
  uint32_t normal = no_index;
};

// The faces of one material.
struct Part {
  std::string material;
  std::vector<Corner> corners;
  std::vector<uint32_t> sizes;                         // number of corners of each face
  std::vector<std::array<uint32_t, 2>> segments = {};  // parts of lines, as indices of vertices
};

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

class ObjReader {
 public:
  explicit ObjReader(MeshFile& file)
      : materials(file.assets, *file.pixels),
        lines(file.name, file.options.line_width),
        file_(file),
        text_(file.bytes) {}

  void read() {
    while (begin_ < text_.size()) {
      end_ = std::min(text_.find('\n', begin_), text_.size());
      read_statement();
      begin_ = end_ + 1;
    }
    // Check indices at the end: corners may refer to later vertices.
    check(highest_position_, vertices.positions.size(), "vertex");
    check(highest_uv_, vertices.uv.size(), "texture coordinate");
    check(highest_normal_, vertices.normals.size(), "normal");
  }

  VertexPool vertices;
  std::vector<Part> parts;
  ObjMaterials materials;
  LineBuilder lines;
  size_t points = 0;  // elements `p`
  bool curves = false;

 private:
  // The highest index of one kind so far, and its position in the text.
  struct Highest {
    uint32_t index = 0;
    size_t at = 0;
    bool any = false;
  };

  [[noreturn]] void fail(size_t at, const std::string& message) const {
    throw malformed_at(file_.name, text_, at, message);
  }
  void check(const Highest& highest, size_t count, const char* what) const {
    if (highest.any && highest.index >= count)
      fail(highest.at, fmt::format("there is no {} {}: the file has {}", what, highest.index + 1, count));
  }

  void read_statement();
  void read_vertex();
  void read_face();
  void read_line();
  Part& current_part();
  Corner read_corner();
  uint32_t read_index(size_t count, Highest& highest, const char* what);
  int read_numbers(std::array<double, 7>& numbers, int most);
  void use_material(std::string_view name);

  // Steps over spaces, and from the end of a line to the next line if a backslash continues it.
  void skip_space() {
    for (;;) {
      while (at_ < end_ && is_space(text_[at_])) ++at_;
      const bool goes_on = at_ < end_ && text_[at_] == '\\' &&
                           (at_ + 1 == end_ || (at_ + 2 == end_ && text_[at_ + 1] == '\r'));
      if (!goes_on || end_ == text_.size()) return;
      at_ = end_ + 1;
      end_ = std::min(text_.find('\n', at_), text_.size());
    }
  }
  // The rest of the line, without spaces around it.
  std::string_view rest() {
    skip_space();
    std::string_view line = text_.substr(at_, end_ - at_);
    while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
    return line;
  }
  bool takes(std::string_view keyword) {
    const bool found = text_.substr(at_, end_ - at_).starts_with(keyword) &&
                       (at_ + keyword.size() == end_ || is_space(text_[at_ + keyword.size()]));
    if (found) at_ += keyword.size();
    return found;
  }

  MeshFile& file_;
  std::string_view text_;
  size_t begin_ = 0;  // the beginning of the line
  size_t end_ = 0;    // the position of its line break
  size_t at_ = 0;     // the next character
  size_t part_ = no_part;
  static constexpr size_t no_part = std::numeric_limits<size_t>::max();
  std::map<std::string, size_t, std::less<>> part_of_material_;
  Highest highest_position_;
  Highest highest_uv_;
  Highest highest_normal_;
  size_t segments_ = 0;  // number of all parts of lines
};

void ObjReader::read_statement() {
  at_ = begin_;
  while (at_ < end_ && is_space(text_[at_])) ++at_;
  if (at_ == end_ || text_[at_] == '#') return;
  std::array<double, 7> numbers;
  if (takes("v")) {
    read_vertex();
  } else if (takes("vn")) {
    if (read_numbers(numbers, 3) < 3) fail(begin_, "a normal has three numbers");
    vertices.normals.emplace_back(numbers[0], numbers[1], numbers[2]);
  } else if (takes("vt")) {
    numbers[1] = 0;
    if (read_numbers(numbers, 3) < 1) fail(begin_, "a texture coordinate has one to three numbers");
    vertices.uv.emplace_back(numbers[0], numbers[1]);
  } else if (takes("f") || takes("fo")) {
    read_face();
  } else if (takes("usemtl")) {
    use_material(rest());
  } else if (takes("mtllib")) {
    materials.load(rest());
  } else if (takes("l")) {
    read_line();
  } else if (takes("p")) {
    ++points;
  } else if (takes("curv") || takes("surf")) {
    curves = true;
  }
  // Groups, names, smoothing groups and statements of single programs are ignored.
}

void ObjReader::read_vertex() {
  std::array<double, 7> numbers;
  const int count = read_numbers(numbers, 7);
  if (count < 3) fail(begin_, "a vertex has three numbers");
  vertices.positions.emplace_back(numbers[0], numbers[1], numbers[2]);
  if (count < 6 && vertices.colors.empty()) return;

  // A colour comes last, behind the weight if there is one. Vertices without a colour are white.
  vertices.colors.resize(vertices.positions.size() - 1, Vec3(1));
  const auto first = static_cast<size_t>(count) - 3;
  vertices.colors.push_back(
      count < 6 ? Vec3(1) : color_from_display({numbers[first], numbers[first + 1], numbers[first + 2]}));
}

// Reads at most `most` numbers, and leaves the text that follows them. Returns their count.
int ObjReader::read_numbers(std::array<double, 7>& numbers, int most) {
  int count = 0;
  for (; count < most; ++count) {
    skip_space();
    if (at_ == end_ || text_[at_] == '#') break;
    const size_t start = at_;
    if (text_[at_] == '+') ++at_;
    double& value = numbers[static_cast<size_t>(count)];
    const auto [after, error] = std::from_chars(text_.data() + at_, text_.data() + end_, value);
    if (error == std::errc::result_out_of_range)
      value = std::strtod(text_.data() + at_, nullptr);  // 0 or ±inf
    at_ = static_cast<size_t>(after - text_.data());
    if (error == std::errc::invalid_argument || (at_ < end_ && !is_space(text_[at_])))
      fail(start, "this is not a number");
  }
  return count;
}

Part& ObjReader::current_part() {
  if (part_ == no_part) use_material("");
  return parts[part_];
}

void ObjReader::read_line() {
  if (!lines.shows()) return lines.leave_out(1);
  Part& part = current_part();
  std::optional<uint32_t> before;
  for (skip_space(); at_ < end_ && text_[at_] != '#'; skip_space()) {
    const uint32_t vertex = read_corner().position;
    if (before) {
      lines.check_room(++segments_);
      part.segments.push_back({*before, vertex});
    }
    before = vertex;
  }
}

void ObjReader::read_face() {
  Part& part = current_part();
  const size_t start = part.corners.size();
  for (skip_space(); at_ < end_ && text_[at_] != '#'; skip_space()) part.corners.push_back(read_corner());
  part.sizes.push_back(static_cast<uint32_t>(part.corners.size() - start));
}

// Reads a corner: `position`, `position/uv`, `position//normal` or `position/uv/normal`.
Corner ObjReader::read_corner() {
  const auto slash = [this] {
    const bool found = at_ < end_ && text_[at_] == '/';
    if (found) ++at_;
    return found;
  };
  Corner corner{read_index(vertices.positions.size(), highest_position_, "vertex")};
  if (slash()) {
    if (at_ < end_ && text_[at_] != '/' && !is_space(text_[at_]))
      corner.uv = read_index(vertices.uv.size(), highest_uv_, "texture coordinate");
    if (slash() && at_ < end_ && !is_space(text_[at_]))
      corner.normal = read_index(vertices.normals.size(), highest_normal_, "normal");
  }
  if (at_ < end_ && !is_space(text_[at_])) fail(at_, "a corner of a face is written 1, 1/2, 1//3 or 1/2/3");
  return corner;
}

// Reads an index and returns it counted from 0. The file counts from 1, or backwards: −1 is the last so far.
uint32_t ObjReader::read_index(size_t count, Highest& highest, const char* what) {
  const size_t start = at_;
  int64_t written = 0;
  const auto [after, error] = std::from_chars(text_.data() + at_, text_.data() + end_, written);
  if (error != std::errc()) fail(start, fmt::format("this is not an index of a {}", what));
  at_ = static_cast<size_t>(after - text_.data());
  const int64_t index = written > 0 ? written - 1 : static_cast<int64_t>(count) + written;
  if (written == 0) fail(start, "indices count from 1, so 0 is not allowed");
  if (index < 0)
    fail(start, fmt::format("there is no {} {}: the file has {} up to here", what, written, count));
  if (index >= no_index) fail(start, fmt::format("there is no {} {}", what, written));
  if (!highest.any || index > highest.index) highest = {static_cast<uint32_t>(index), start, true};
  return static_cast<uint32_t>(index);
}

void ObjReader::use_material(std::string_view name) {
  auto known = part_of_material_.find(name);
  if (known == part_of_material_.end()) {
    known = part_of_material_.emplace(name, parts.size()).first;
    parts.push_back({std::string(name), {}, {}});
  }
  part_ = known->second;
}

// The part's faces as triangles with indices into the pool.
RawTriangles triangulate(const Part& part, const VertexPool& vertices, MeshCounts& counts) {
  RawTriangles raw;
  for (const Corner& corner : part.corners) {
    raw.has_uv = raw.has_uv || corner.uv != no_index;
    raw.has_normals = raw.has_normals || corner.normal != no_index;
  }
  raw.positions.reserve(part.sizes.size());
  Triangulator triangulator;
  std::vector<Vec3> points;
  const Corner* corner = part.corners.data();
  for (const uint32_t size : part.sizes) {
    points.clear();
    for (uint32_t i = 0; i < size; ++i) points.push_back(vertices.positions[corner[i].position]);
    for (const auto& [a, b, c] : triangulator.cut(points)) {
      raw.positions.push_back({corner[a].position, corner[b].position, corner[c].position});
      if (raw.has_uv) raw.uv.push_back({corner[a].uv, corner[b].uv, corner[c].uv});
      if (raw.has_normals) raw.normals.push_back({corner[a].normal, corner[b].normal, corner[c].normal});
    }
    if (size < 3) ++counts.without_area;
    corner += size;
  }
  counts.fans += triangulator.fans();
  return raw;
}

}  // namespace

ImportedScene import_obj(MeshFile& file) {
  end_lines_with_newlines(file.bytes);
  ObjReader reader(file);
  reader.read();
  free_memory(file.bytes);  // the meshes need the memory

  ImportedScene scene;
  scene.warnings = std::move(reader.materials.warnings);
  size_t unknown = 0;
  std::string example;
  MeshCounts counts;
  MeshBuilder builder(reader.vertices, counts);
  for (Part& part : reader.parts) {
    if (!part.segments.empty()) {
      std::vector<LineSegment> segments;
      for (const auto& [from, to] : part.segments)
        segments.push_back({reader.vertices.positions[from], reader.vertices.positions[to]});
      reader.lines.add(std::move(segments), reader.materials.find(part.material), scene);
    }
    if (part.sizes.empty()) continue;
    RawTriangles raw = triangulate(part, reader.vertices, counts);
    raw.name = part.material.empty() ? file.name : fmt::format("{}: {}", file.name, part.material);
    const int material = reader.materials.find(part.material);
    if (material < 0 && !part.material.empty() && unknown++ == 0) example = part.material;
    scene.instances.push_back({static_cast<int>(scene.meshes.size()), Mat4(1.0), material, {}});
    scene.meshes.push_back(builder.build(raw, file.options.smooth.value_or(default_smooth)));
    if (material >= 0)
      for (Vec2& uv : scene.meshes.back().uv)
        uv = uv * reader.materials.uv(material).scale + reader.materials.uv(material).offset;
    part = {};
  }
  scene.materials = std::move(reader.materials.materials);

  if (unknown > 0) {
    scene.warnings.push_back(fmt::format("{} of its materials {} not defined, such as `{}`", unknown,
                                         unknown == 1 ? "is" : "are", example));
  }
  // A file without faces and lines is one of points, of which few have elements `p`.
  const bool shows_points = scene.instances.empty() && scene.lines.empty();
  reader.lines.report(scene.warnings);
  if (!shows_points && reader.points > 0)
    scene.warnings.push_back(fmt::format("{} points were left out", reader.points));
  if (shows_points) {
    RawPoints raw{file.name, std::move(reader.vertices.positions), std::move(reader.vertices.colors)};
    // Programs write the normals in the order of the points.
    if (reader.vertices.normals.size() == raw.positions.size())
      raw.normals = std::move(reader.vertices.normals);
    if (auto cloud = build_cloud(std::move(raw), file.options, scene.warnings))
      scene.clouds.push_back({std::move(cloud)});
  }
  if (reader.curves) scene.warnings.emplace_back("free-form curves and surfaces were left out");
  counts.report(scene.warnings);
  return scene;
}

}  // namespace eyeray::engine::importers
