// PLY: vertices with whatever properties, and polygons or strips of triangles.
#include <algorithm>
#include <array>
#include <cmath>

#include "host/core/free_memory.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/mesh_builder.hpp"
#include "host/importers/ply_header.hpp"
#include "host/importers/ply_values.hpp"
#include "host/importers/polygon.hpp"
#include "host/importers/texture_files.hpp"
#include "host/materials/make.hpp"

namespace eyeray::importers {

namespace {

// What a property of a vertex is, or none of it.
enum Slot { x, y, z, nx, ny, nz, u, v, red, green, blue, none };

constexpr std::pair<std::string_view, Slot> slot_names[] = {
    {"x", x},
    {"y", y},
    {"z", z},
    {"nx", nx},
    {"ny", ny},
    {"nz", nz},
    {"s", u},
    {"t", v},
    {"u", u},
    {"v", v},
    {"texture_u", u},
    {"texture_v", v},
    {"texture_s", u},
    {"texture_t", v},
    {"red", red},
    {"green", green},
    {"blue", blue},
    {"r", red},
    {"g", green},
    {"b", blue},
    {"diffuse_red", red},
    {"diffuse_green", green},
    {"diffuse_blue", blue},
};

// What a colour is at its brightest.
double brightest(PlyType type) {
  switch (type) {
    case PlyType::uint8:
    case PlyType::int8:
      return 255;
    case PlyType::uint16:
    case PlyType::int16:
      return 65535;
    default:
      return 1;
  }
}

// The corners of polygons, one after the other.
struct Polygons {
  std::vector<uint32_t> corners;
  std::vector<uint32_t> sizes;
};

template <typename Values>
class PlyReader {
 public:
  PlyReader(const PlyHeader& header, const MeshFile& file)
      : header_(header), file_(file), values_(file.bytes, header.size, file.name) {}

  void read() {
    for (const PlyElement& element : header_.elements) {
      check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_lists(element, [this](uint64_t count, PlyType type) { read_face(count, type); });
      } else if (element.name == "tristrips") {
        read_lists(element, [this](uint64_t count, PlyType type) { read_strip(count, type); });
      } else {
        skip(element);
      }
    }
  }

  VertexPool vertices;
  Polygons polygons;
  std::vector<std::string> warnings;

 private:
  void check_count(const PlyElement& element) const;
  void read_vertices(const PlyElement& element);
  template <typename Read>
  void read_lists(const PlyElement& element, const Read& read);
  void skip(const PlyElement& element);
  void skip_value(const PlyProperty& property) {
    values_.skip(property.type, property.list ? read_length(property) : 1);
  }
  uint64_t read_length(const PlyProperty& property);
  void read_face(uint64_t count, PlyType type);
  void read_strip(uint64_t count, PlyType type);
  uint32_t read_index(PlyType type);

  const PlyHeader& header_;
  const MeshFile& file_;
  Values values_;
};

// Whatever the header says, no more can come than there are bytes; so memory may be taken for all that it
// says.
template <typename Values>
void PlyReader<Values>::check_count(const PlyElement& element) const {
  const size_t least = element.least_bytes(header_.format);
  const size_t left = file_.bytes.size() - header_.size + 1;  // the last number of a text needs no space
  if (least > 0 && element.count > left / least) {
    values_.fail(fmt::format("the header promises {} of `{}`, more than the file's {} bytes can hold",
                             element.count, element.name, file_.bytes.size()));
  }
}

template <typename Values>
void PlyReader<Values>::read_vertices(const PlyElement& element) {
  if (!vertices.positions.empty()) values_.fail("the header has the element `vertex` twice");
  std::vector<Slot> meaning;
  bool has[none + 1] = {};
  for (const PlyProperty& property : element.properties) {
    const auto known =
        std::ranges::find(slot_names, property.name, [](const auto& row) { return row.first; });
    meaning.push_back(known != std::end(slot_names) && !property.list ? known->second : none);
    has[meaning.back()] = true;
  }
  if (!has[x] || !has[y] || !has[z]) values_.fail("the vertices have no x, y and z");
  const bool normals = has[nx] && has[ny] && has[nz];
  const bool uv = has[u] && has[v];
  const bool colors = has[red] && has[green] && has[blue];

  vertices.positions.reserve(element.count);
  if (normals) vertices.normals.reserve(element.count);
  if (uv) vertices.uv.reserve(element.count);
  if (colors) vertices.colors.reserve(element.count);
  std::array<double, none + 1> row{};
  for (uint64_t i = 0; i < element.count; ++i) {
    for (size_t k = 0; k < meaning.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (property.list) {
        skip_value(property);
      } else {
        const double value = values_.next(property.type);
        row[meaning[k]] = meaning[k] >= red ? value / brightest(property.type) : value;
      }
    }
    vertices.positions.emplace_back(row[x], row[y], row[z]);
    if (normals) vertices.normals.emplace_back(row[nx], row[ny], row[nz]);
    if (uv) vertices.uv.emplace_back(row[u], row[v]);
    if (colors) vertices.colors.push_back(color_from_display({row[red], row[green], row[blue]}));
  }
}

// Reads the list of vertices in each element, and steps over all else.
template <typename Values>
template <typename Read>
void PlyReader<Values>::read_lists(const PlyElement& element, const Read& read) {
  const auto wanted = std::ranges::find_if(element.properties, [](const PlyProperty& property) {
    return property.list && (property.name == "vertex_indices" || property.name == "vertex_index");
  });
  if (wanted == element.properties.end())
    values_.fail(fmt::format("the element `{}` has no list of vertex_indices", element.name));
  const auto has = [&](std::string_view name) {
    return std::ranges::find(element.properties, name, &PlyProperty::name) != element.properties.end();
  };
  if (has("texcoord")) warnings.emplace_back("the uv of faces (texcoord) were left out");
  if (has("red") || has("diffuse_red") || has("r"))
    warnings.emplace_back("the colours of faces were left out: only those of vertices are shown");
  polygons.sizes.reserve(polygons.sizes.size() + element.count);
  for (uint64_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      if (&property == &*wanted) {
        const uint64_t count = read_length(property);
        read(count, property.type);
      } else {
        skip_value(property);
      }
    }
  }
}

template <typename Values>
void PlyReader<Values>::skip(const PlyElement& element) {
  if (element.properties.empty()) return;
  for (uint64_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) skip_value(property);
  }
}

template <typename Values>
uint64_t PlyReader<Values>::read_length(const PlyProperty& property) {
  const double length = values_.next(*property.list);
  if (!(length >= 0) || length != std::trunc(length)) values_.fail("the length of a list must be an integer");
  if (length > static_cast<double>(values_.room(property.type)))
    values_.fail(fmt::format("a list of {:.0f} is longer than the rest of the file", length));
  return static_cast<uint64_t>(length);
}

// no_index for −1; whether it is that of a vertex is asked once all are known.
template <typename Values>
uint32_t PlyReader<Values>::read_index(PlyType type) {
  const double index = values_.next(type);
  if (index == -1) return no_index;
  if (!(index >= 0 && index < no_index) || index != std::trunc(index))
    values_.fail(fmt::format("{} is no index of a vertex", index));
  return static_cast<uint32_t>(index);
}

template <typename Values>
void PlyReader<Values>::read_face(uint64_t count, PlyType type) {
  for (uint64_t i = 0; i < count; ++i) polygons.corners.push_back(read_index(type));
  polygons.sizes.push_back(static_cast<uint32_t>(count));
}

// Each corner makes a triangle with the two before it, every other one turned round; −1 starts anew.
template <typename Values>
void PlyReader<Values>::read_strip(uint64_t count, PlyType type) {
  std::array<uint32_t, 2> before{};
  size_t corners = 0;
  for (uint64_t i = 0; i < count; ++i) {
    const uint32_t corner = read_index(type);
    if (corner == no_index) {
      corners = 0;
      continue;
    }
    if (corners >= 2) {
      const bool turned = corners % 2 == 1;
      polygons.corners.insert(polygons.corners.end(), {before[turned], before[!turned], corner});
      polygons.sizes.push_back(3);
    }
    before = {before[1], corner};
    ++corners;
  }
}

// The polygons as triangles.
std::vector<IndexTriangle> triangulate(const Polygons& polygons, const VertexPool& vertices,
                                       MeshCounts& counts, const std::string& file) {
  const auto known = [&](uint32_t corner) { return corner < vertices.positions.size(); };
  if (const auto wrong = std::ranges::find_if_not(polygons.corners, known); wrong != polygons.corners.end()) {
    throw malformed(file, fmt::format("a face refers to vertex {}; there are {}, counted from 0",
                                      *wrong == no_index ? -1 : int64_t{*wrong}, vertices.positions.size()));
  }
  std::vector<IndexTriangle> triangles;
  triangles.reserve(polygons.sizes.size());
  Triangulator triangulator;
  std::vector<Vec3> points;
  const uint32_t* corner = polygons.corners.data();
  for (const uint32_t size : polygons.sizes) {
    if (size == 3) {
      triangles.push_back({corner[0], corner[1], corner[2]});
    } else {
      points.clear();
      for (uint32_t i = 0; i < size; ++i) points.push_back(vertices.positions[corner[i]]);
      for (const auto& [a, b, c] : triangulator.cut(points))
        triangles.push_back({corner[a], corner[b], corner[c]});
      if (size < 3) ++counts.without_area;
    }
    corner += size;
  }
  counts.fans += triangulator.fans();
  return triangles;
}

// Makes a material of the picture that the file names, if it has uv for it; returns whether.
bool show_picture(const PlyHeader& header, MeshFile& file, bool has_uv, ImportedScene& scene) {
  if (header.pictures.empty()) return false;
  if (!has_uv || header.pictures.size() > 1) {
    scene.warnings.emplace_back(
        fmt::format("its {} (comment TextureFile) left out: {}; give the mesh a `material`",
                    has_uv ? "pictures were" : "picture was",
                    has_uv ? "there is more than one" : "its vertices have no uv"));
    return false;
  }
  TextureFiles textures(file.assets, *file.pixels, scene.warnings);
  const auto picture = textures.load(header.pictures[0]);
  if (!picture) return false;
  scene.materials.push_back(materials::make_phong({.diffuse = textures::make_image(picture)}));
  return true;
}

template <typename Values>
ImportedScene import_values(const PlyHeader& header, MeshFile& file) {
  PlyReader<Values> reader(header, file);
  reader.read();
  free_memory(file.bytes);  // make room

  ImportedScene scene;
  scene.warnings = std::move(reader.warnings);
  if (reader.polygons.sizes.empty())
    throw malformed(file.name, "it has no faces: points alone cannot be seen");
  MeshCounts counts;
  RawTriangles raw;
  raw.name = file.name;
  raw.has_normals = !reader.vertices.normals.empty();
  raw.has_uv = !reader.vertices.uv.empty();
  raw.positions = triangulate(reader.polygons, reader.vertices, counts, file.name);
  reader.polygons = {};
  scene.meshes.push_back(
      MeshBuilder(reader.vertices, counts).build(raw, file.smooth.value_or(default_smooth)));
  const bool shown = show_picture(header, file, raw.has_uv, scene);
  scene.instances.push_back({0, Mat4(1.0), shown ? 0 : -1, {}});
  counts.report(scene.warnings);
  return scene;
}

}  // namespace

ImportedScene import_ply(MeshFile& file) {
  const PlyHeader header = read_ply_header(file.bytes, file.name);
  switch (header.format) {
    case PlyFormat::ascii:
      return import_values<AsciiValues>(header, file);
    case PlyFormat::little_endian:
      return import_values<BinaryValues<std::endian::little>>(header, file);
    case PlyFormat::big_endian:
      return import_values<BinaryValues<std::endian::big>>(header, file);
  }
  return {};
}

}  // namespace eyeray::importers
