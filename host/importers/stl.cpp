// Reads STL, text and binary: triangles that share no corners, and the colours that two programs' files have.
// Sources: 3D Systems, StereoLithography Interface Specification (1989); for colours, the header's "COLOR="
// of Materialise Magics, and VisCAM's attributes.
#include <array>
#include <bit>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "host/core/free_memory.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/malformed.hpp"
#include "host/importers/mesh_builder.hpp"

namespace eyeray::engine::importers {

namespace {

constexpr size_t header_bytes = 80, start_of_facets = 84, facet_bytes = 50;
// The colour of facets that have none, in a file where others have one: that of plain_material().
constexpr double plain_gray = 0.75;

// The facets of a file, each with corners of its own.
struct Facets {
  VertexPool vertices;
  RawTriangles triangles;
  size_t turned = 0;  // facets whose normal points against the order of their corners

  void add(const Vec3& normal, const std::array<Vec3, 3>& corners) {
    const auto first = static_cast<uint32_t>(vertices.positions.size());
    for (const Vec3& corner : corners) vertices.positions.push_back(corner);
    triangles.positions.push_back({first, first + 1, first + 2});
    turned += glm::dot(normal, glm::cross(corners[1] - corners[0], corners[2] - corners[0])) < 0;
  }
  void color(const Vec3& rgb) {
    triangles.colors.push_back(static_cast<uint32_t>(vertices.colors.size()));
    vertices.colors.push_back(rgb);
  }
};

uint32_t little_endian(std::string_view bytes, size_t at, size_t size) {
  uint32_t value = 0;
  for (size_t i = 0; i < size; ++i) value |= uint32_t{static_cast<unsigned char>(bytes[at + i])} << 8 * i;
  return value;
}

Vec3 point_at(std::string_view bytes, size_t at) {
  Vec3 point;
  for (int i = 0; i < 3; ++i)
    point[i] =
        static_cast<double>(std::bit_cast<float>(little_endian(bytes, at + 4 * static_cast<size_t>(i), 4)));
  return point;
}

// A colour of five bits a channel; `first`: the bit where red begins, with blue 10 bits from it.
Vec3 color_of_attribute(uint32_t attribute, bool red_is_low) {
  Vec3 rgb;
  for (int i = 0; i < 3; ++i) rgb[red_is_low ? i : 2 - i] = double(attribute >> 5 * i & 31) / 31;
  return color_from_display(rgb);
}

// Gives the facets the colours of their attributes, if the file has any.
void add_colors(std::string_view bytes, size_t count, Facets& facets, std::vector<std::string>& warnings) {
  const std::string_view header = bytes.substr(0, header_bytes);
  const size_t of_all = header.find("COLOR=");
  const bool by_magics = of_all != std::string_view::npos && of_all + 10 <= header_bytes;
  const auto attribute = [&](size_t i) {
    return little_endian(bytes, start_of_facets + i * facet_bytes + facet_bytes - 2, 2);
  };
  Vec3 others(plain_gray);
  bool any = by_magics;
  if (by_magics) {
    Vec3 rgb;
    for (int i = 0; i < 3; ++i)
      rgb[i] = little_endian(header, of_all + 6 + static_cast<size_t>(i), 1) / 255.0;
    others = color_from_display(rgb);
    if (little_endian(header, of_all + 9, 1) < 255)
      warnings.emplace_back(
          "the transparency of its colours was left out: give the mesh a `material` with `alpha`");
    if (header.find("MATERIAL=") != std::string_view::npos)
      warnings.emplace_back("its material (MATERIAL=) was left out: give the mesh a `material`");
  }
  // With the bit set, a facet has the colour of all in Magics' files, and its own in VisCAM's.
  const auto has_own = [&](uint32_t value) { return (value >> 15 == 0) == by_magics; };
  for (size_t i = 0; i < count && !any; ++i) any = has_own(attribute(i));
  for (size_t i = 0; i < count && any; ++i)
    facets.color(has_own(attribute(i)) ? color_of_attribute(attribute(i), by_magics) : others);
}

Facets read_binary(const MeshFile& file, size_t count, std::vector<std::string>& warnings) {
  const std::string_view bytes = file.bytes;
  Facets facets;
  facets.vertices.positions.reserve(3 * count);
  facets.triangles.positions.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const size_t at = start_of_facets + i * facet_bytes;
    facets.add(point_at(bytes, at),
               {point_at(bytes, at + 12), point_at(bytes, at + 24), point_at(bytes, at + 36)});
  }
  add_colors(bytes, count, facets, warnings);
  const size_t rest = bytes.size() - start_of_facets - count * facet_bytes;
  if (rest > 0) warnings.push_back(fmt::format("{} bytes after its last triangle were left out", rest));
  return facets;
}

// Reads the words and numbers of a text file, in upper or lower case.
class StlText {
 public:
  StlText(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  bool at_end() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    return at_ == text_.size();
  }
  // Takes the next word if it is this one.
  bool take(std::string_view word) {
    if (at_end() || text_.size() - at_ < word.size()) return false;
    for (size_t i = 0; i < word.size(); ++i)
      if ((text_[at_ + i] | 0x20) != word[i]) return false;
    if (at_ + word.size() < text_.size() && !is_space(text_[at_ + word.size()])) return false;
    at_ += word.size();
    return true;
  }
  void expect(std::string_view word) {
    if (!take(word)) fail(fmt::format("`{}` is missing here", word));
  }
  void skip_line() { at_ = std::min(text_.find_first_of("\r\n", at_), text_.size()); }
  double number() {
    if (at_end()) fail("the file ends too early");
    const size_t begin = at_ + (text_[at_] == '+');
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + begin, text_.data() + text_.size(), value);
    const auto after = static_cast<size_t>(end - text_.data());
    if (error == std::errc::invalid_argument || (after < text_.size() && !is_space(text_[after])))
      fail("this is not a number");
    if (error == std::errc::result_out_of_range)
      value = std::strtod(text_.data() + begin, nullptr);  // 0 or ±inf
    at_ = after;
    return value;
  }
  Vec3 point() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
  [[noreturn]] void fail(const std::string& message) const { throw malformed_at(file_, text_, at_, message); }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

  std::string_view text_;
  const std::string& file_;
  size_t at_ = 0;
};

// A file may have several solids. They are shown together.
Facets read_text(const MeshFile& file) {
  StlText text(file.bytes, file.name);
  Facets facets;
  while (!text.at_end()) {
    text.expect("solid");
    text.skip_line();  // its name
    while (!text.take("endsolid")) {
      text.expect("facet");
      text.expect("normal");
      const Vec3 normal = text.point();
      text.expect("outer");
      text.expect("loop");
      std::array<Vec3, 3> corners;
      for (Vec3& corner : corners) {
        text.expect("vertex");
        corner = text.point();
      }
      text.expect("endloop");
      text.expect("endfacet");
      facets.add(normal, corners);
    }
    text.skip_line();
  }
  return facets;
}

}  // namespace

ImportedScene import_stl(MeshFile& file) {
  const std::string_view bytes = file.bytes;
  const bool has_count = bytes.size() >= start_of_facets;
  const size_t count = has_count ? little_endian(bytes, header_bytes, 4) : 0;
  const size_t room = has_count ? bytes.size() - start_of_facets : 0;
  // Headers of binary files may begin with "solid", too: there the size decides.
  const bool is_exact = has_count && room == count * facet_bytes;
  const bool is_text = !is_exact && StlText(bytes, file.name).take("solid") &&
                       bytes.substr(0, start_of_facets).find('\0') == std::string_view::npos;
  if (!is_text && !has_count)
    throw malformed(file.name, "it is no STL: it neither begins with `solid` nor has a header of 84 bytes");
  if (!is_text && room < count * facet_bytes)
    throw malformed(file.name,
                    fmt::format("its header declares {} triangles of {} bytes, but {} bytes follow", count,
                                facet_bytes, room));
  ImportedScene scene;
  Facets facets = is_text ? read_text(file) : read_binary(file, count, scene.warnings);
  free_memory(file.bytes);  // the mesh needs the memory
  facets.triangles.name = file.name;
  if (facets.turned > 0)
    scene.warnings.push_back(fmt::format(
        "the normals of {} of {} facets point against the order of their corners; the order counts",
        facets.turned, facets.triangles.positions.size()));
  MeshCounts counts;
  MeshBuilder builder(facets.vertices, counts);
  scene.instances.push_back({0, Mat4(1.0), -1, {}});
  scene.meshes.push_back(builder.build(facets.triangles, file.smooth.value_or(default_smooth)));
  counts.report(scene.warnings);
  return scene;
}

}  // namespace eyeray::engine::importers
