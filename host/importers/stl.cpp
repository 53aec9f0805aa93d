// Reads STL, text and binary: triangles that share no corners, and the colours that two programs' files have.
// Sources: 3D Systems, StereoLithography Interface Specification (1989); for colours, the header's "COLOR="
// of Materialise Magics, and VisCAM's attributes.
#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "host/core/free_memory.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/malformed.hpp"
#include "host/importers/mesh_builder.hpp"
#include "host/importers/ply_values.hpp"
#include "host/importers/text_number.hpp"

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

// A colour of five bits a channel. `red_is_low`: its lowest bits are red, else blue.
Vec3 color_of_attribute(uint32_t attribute, bool red_is_low) {
  Vec3 rgb;
  for (int i = 0; i < 3; ++i) rgb[red_is_low ? i : 2 - i] = double(attribute >> 5 * i & 31) / 31;
  return color_from_display(rgb);
}

// Gives the facets the colours of their attributes, if the file has any.
void add_colors(std::string_view header, std::span<const uint32_t> attributes, Facets& facets,
                std::vector<std::string>& warnings) {
  const size_t of_all = header.find("COLOR=");
  const bool by_magics = of_all != std::string_view::npos && of_all + 10 <= header.size();
  Vec3 others(plain_gray);
  if (by_magics) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(header[of_all + 6 + i]); };
    others = color_from_display(Vec3(byte(0), byte(1), byte(2)) / 255.0);
    if (byte(3) < 255)
      warnings.emplace_back(
          "the transparency of its colours was left out: give the mesh a `material` with `alpha`");
    if (header.find("MATERIAL=") != std::string_view::npos)
      warnings.emplace_back("its material (MATERIAL=) was left out: give the mesh a `material`");
  }
  // With the bit set, a facet has the colour of all in Magics' files, and its own in VisCAM's.
  const auto has_own = [&](uint32_t attribute) { return (attribute >> 15 == 0) == by_magics; };
  if (!by_magics && std::ranges::none_of(attributes, has_own)) return;
  for (const uint32_t attribute : attributes)
    facets.color(has_own(attribute) ? color_of_attribute(attribute, by_magics) : others);
}

using StlValues = BinaryValues<std::endian::little>;

Facets read_binary(const MeshFile& file, size_t count, std::vector<std::string>& warnings) {
  StlValues values(file.bytes, start_of_facets, file.name);
  const auto point = [&] {
    Vec3 read;
    for (int i = 0; i < 3; ++i) read[i] = values.next(PlyType::float32);
    return read;
  };
  Facets facets;
  facets.vertices.positions.reserve(3 * count);
  facets.triangles.positions.reserve(count);
  std::vector<uint32_t> attributes(count);
  for (uint32_t& attribute : attributes) {
    const Vec3 normal = point(), a = point(), b = point();
    facets.add(normal, {a, b, point()});
    attribute = static_cast<uint32_t>(values.next(PlyType::uint16));
  }
  add_colors(std::string_view(file.bytes).substr(0, header_bytes), attributes, facets, warnings);
  const uint64_t rest = values.room(PlyType::uint8);
  if (rest > 0) warnings.push_back(fmt::format("{} bytes after its last triangle were left out", rest));
  return facets;
}

// Reads the words and numbers of a text file, in upper or lower case.
class StlText {
 public:
  StlText(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  bool at_end() {
    at_ = skip_spaces(text_, at_);
    return at_ == text_.size();
  }
  // Takes the next word if it is this one.
  bool take(std::string_view word) {
    if (at_end() || text_.size() - at_ < word.size()) return false;
    for (size_t i = 0; i < word.size(); ++i)
      if ((text_[at_ + i] | 0x20) != word[i]) return false;
    if (at_ + word.size() < text_.size() && !is_text_space(text_[at_ + word.size()])) return false;
    at_ += word.size();
    return true;
  }
  void expect(std::string_view word) {
    if (!take(word)) fail(fmt::format("`{}` is missing here", word));
  }
  void skip_line() { at_ = std::min(text_.find_first_of("\r\n", at_), text_.size()); }
  double number() { return take_number(text_, at_, file_); }
  Vec3 point() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
  [[noreturn]] void fail(const std::string& message) const { throw malformed_at(file_, text_, at_, message); }

 private:
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
  const size_t count =
      has_count ? static_cast<size_t>(StlValues(bytes, header_bytes, file.name).next(PlyType::uint32)) : 0;
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
  scene.meshes.push_back(builder.build(facets.triangles, file.options.smooth.value_or(default_smooth)));
  counts.report(scene.warnings);
  return scene;
}

}  // namespace eyeray::engine::importers
