// Reads PLY: vertices with any properties, and polygons or strips of triangles.
#include <algorithm>
#include <array>
#include <cmath>

#include "host/core/free_memory.hpp"
#include "host/importers/cloud_builder.hpp"
#include "host/importers/file_polygons.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/ply_header.hpp"
#include "host/importers/ply_slots.hpp"
#include "host/importers/ply_values.hpp"
#include "host/importers/texture_files.hpp"
#include "host/materials/make.hpp"

namespace eyeray::engine::importers {

namespace {

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
        read_faces(element);
      } else if (element.name == "tristrips") {
        read_strips(element);
      } else {
        skip(element);
      }
    }
  }

  VertexPool vertices;
  FilePolygons polygons;
  size_t transparent = 0;  // colours with an alpha below 1

 private:
  void check_count(const PlyElement& element) const;
  void read_vertices(const PlyElement& element);
  const PlyProperty& corners_of(const PlyElement& element) const;
  void read_faces(const PlyElement& element);
  void read_uv(const PlyProperty& property, std::vector<Vec2>& uv);
  void read_strips(const PlyElement& element);
  void skip(const PlyElement& element);
  void skip_value(const PlyProperty& property) {
    values_.skip(property.type, property.list ? read_length(property) : 1);
  }
  uint64_t read_length(const PlyProperty& property);
  void read_strip(uint64_t count, PlyType type);
  uint32_t read_index(PlyType type);

  const PlyHeader& header_;
  const MeshFile& file_;
  Values values_;
};

// Checks the header's count against the file's size, so that memory may be allocated for all elements.
template <typename Values>
void PlyReader<Values>::check_count(const PlyElement& element) const {
  const size_t least = element.least_bytes(header_.format);
  const size_t left =
      file_.bytes.size() - header_.size + 1;  // the last number of a text file needs no space after it
  if (least > 0 && element.count > left / least) {
    values_.fail(fmt::format("the header declares {} of `{}`, more than the file's {} bytes can contain",
                             element.count, element.name, file_.bytes.size()));
  }
}

template <typename Values>
void PlyReader<Values>::read_vertices(const PlyElement& element) {
  if (!vertices.positions.empty()) values_.fail("the header has the element `vertex` twice");
  std::vector<Slot> meaning;
  bool has[none + 1] = {};
  for (const PlyProperty& property : element.properties) {
    meaning.push_back(property.list ? none : slot_of(property.name));
    has[meaning.back()] = true;
  }
  if (!has[x] || !has[y] || !has[z]) values_.fail("the vertices must have x, y and z");
  const bool disks = file_.options.point_shape == PointShape::disk;
  const bool normals = has[nx] && has[ny] && has[nz] && (header_.has_faces() || disks);
  const bool uv = has[u] && has[v] && header_.has_faces();
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
    transparent += colors && has[alpha] && row[alpha] < 1;
  }
}

// The property of an element that lists its vertices.
template <typename Values>
const PlyProperty& PlyReader<Values>::corners_of(const PlyElement& element) const {
  const auto found = std::ranges::find_if(element.properties, [](const PlyProperty& property) {
    return property.list && (property.name == "vertex_indices" || property.name == "vertex_index");
  });
  if (found == element.properties.end())
    values_.fail(fmt::format("the element `{}` has no list of vertex_indices", element.name));
  return *found;
}

// Reads polygons, with the texture coordinates, the colours and the picture's number that each may have.
template <typename Values>
void PlyReader<Values>::read_faces(const PlyElement& element) {
  const PlyProperty& corners = corners_of(element);
  std::vector<Slot> meaning;
  bool has[none + 1] = {};
  const PlyProperty *uv_list = nullptr, *picture = nullptr;
  for (const PlyProperty& property : element.properties) {
    meaning.push_back(property.list ? none : slot_of(property.name));
    has[meaning.back()] = true;
    if (property.name == "texcoord" && property.list) uv_list = &property;
    if (property.name == "texnumber" && !property.list) picture = &property;
  }
  const bool colored = has[red] && has[green] && has[blue];

  polygons.sizes.reserve(polygons.sizes.size() + element.count);
  if (uv_list) polygons.uv.resize(polygons.corners.size(), Vec2(double(NAN)));
  if (colored) polygons.colors.resize(polygons.sizes.size(), Vec3(1));
  if (picture) polygons.pictures.resize(polygons.sizes.size());
  std::array<double, none + 1> row{};
  std::vector<Vec2> uv;
  for (uint64_t i = 0; i < element.count; ++i) {
    uint64_t size = 0;
    for (size_t k = 0; k < meaning.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (&property == &corners) {
        size = read_length(property);
        for (uint64_t n = 0; n < size; ++n) polygons.corners.push_back(read_index(property.type));
      } else if (&property == uv_list) {
        read_uv(property, uv);
      } else if (&property == picture) {
        polygons.pictures.push_back(read_index(property.type));
      } else if (colored && meaning[k] >= red && meaning[k] <= alpha) {
        row[meaning[k]] = values_.next(property.type) / brightest(property.type);
      } else {
        skip_value(property);
      }
    }
    polygons.sizes.push_back(static_cast<uint32_t>(size));
    if (colored) polygons.colors.push_back(color_from_display({row[red], row[green], row[blue]}));
    transparent += colored && has[alpha] && row[alpha] < 1;
    if (uv_list && !uv.empty() && uv.size() != size)
      values_.fail(fmt::format("a face of {} corners has {} pairs of texcoord", size, uv.size()));
    if (uv_list) {
      uv.resize(size, Vec2(double(NAN)));
      polygons.uv.insert(polygons.uv.end(), uv.begin(), uv.end());
    }
  }
}

// Reads the uv of a face: a pair for each corner, or none.
template <typename Values>
void PlyReader<Values>::read_uv(const PlyProperty& property, std::vector<Vec2>& uv) {
  const uint64_t count = read_length(property);
  if (count % 2 != 0)
    values_.fail(fmt::format("a texcoord of {} numbers has no pair for each corner", count));
  uv.resize(count / 2);
  for (Vec2& pair : uv) {
    pair.x = values_.next(property.type);
    pair.y = values_.next(property.type);
  }
}

template <typename Values>
void PlyReader<Values>::read_strips(const PlyElement& element) {
  const PlyProperty& corners = corners_of(element);
  for (uint64_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      if (&property == &corners) {
        const uint64_t count = read_length(property);
        read_strip(count, property.type);
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

// The index of a vertex, no_index for −1. It is compared with the number of vertices later, in triangulate().
template <typename Values>
uint32_t PlyReader<Values>::read_index(PlyType type) {
  const double index = values_.next(type);
  if (index == -1) return no_index;
  if (!(index >= 0 && index < no_index) || index != std::trunc(index))
    values_.fail(fmt::format("{} is not an index of a vertex", index));
  return static_cast<uint32_t>(index);
}

// Reads a strip: each corner makes a triangle with the two before it, and every other triangle is reversed.
// An index of −1 begins a new strip.
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

// Makes a material of each picture that the file names, if there are uv, and faces name the picture that they
// show. Returns the index of each picture's material, or −1.
std::vector<int> show_pictures(const PlyHeader& header, MeshFile& file, size_t shown, bool has_uv,
                               ImportedScene& scene) {
  std::vector<int> materials(shown, -1);
  const size_t pictures = header.pictures.size();
  if (pictures == 0) return materials;
  if (!has_uv || pictures != shown) {
    scene.warnings.emplace_back(
        fmt::format("its {} (comment TextureFile) {} left out: {}; give the mesh a `material`",
                    pictures > 1 ? "pictures" : "picture", pictures > 1 ? "were" : "was",
                    has_uv ? "no texnumber of its faces selects one" : "it has no uv"));
    return materials;
  }
  TextureFiles textures(file.assets, *file.pixels, scene.warnings);
  for (size_t i = 0; i < pictures; ++i) {
    const auto picture = textures.load(header.pictures[i]);
    if (!picture) continue;
    materials[i] = static_cast<int>(scene.materials.size());
    scene.materials.push_back(materials::make_phong({.diffuse = textures::make_image(picture)}));
  }
  return materials;
}

// Shows the vertices of a file without faces.
template <typename Values>
ImportedScene show_points(const PlyHeader& header, PlyReader<Values> reader, const MeshFile& file) {
  ImportedScene scene;
  if (reader.transparent > 0)
    scene.warnings.push_back(
        fmt::format("the transparency (alpha) of {} of its points was left out", reader.transparent));
  if (!header.pictures.empty())
    scene.warnings.emplace_back("its pictures (comment TextureFile) were left out: it has no faces");
  std::vector<std::string> rest;
  for (const PlyElement& element : header.elements)
    for (const PlyProperty& property : element.properties)
      if (element.name == "vertex" && !is_shown_of_points(property, !reader.vertices.normals.empty()))
        rest.push_back(property.name);
  report_left_out("properties", std::move(rest), scene.warnings);
  RawPoints points{file.name, std::move(reader.vertices.positions), std::move(reader.vertices.colors),
                   std::move(reader.vertices.normals)};
  if (auto cloud = build_cloud(std::move(points), file.options, scene.warnings))
    scene.clouds.push_back({std::move(cloud)});
  return scene;
}

template <typename Values>
ImportedScene import_values(const PlyHeader& header, MeshFile& file) {
  PlyReader<Values> reader(header, file);
  reader.read();
  free_memory(file.bytes);  // the meshes need the memory

  if (reader.polygons.sizes.empty()) return show_points(header, std::move(reader), file);
  ImportedScene scene;
  MeshCounts counts;
  const bool own_uv = !reader.polygons.uv.empty();
  add_values_of_faces(reader.polygons, reader.vertices, scene.warnings);
  const std::vector<RawTriangles> lists =
      triangulate(reader.polygons, reader.vertices, header.pictures.size(), own_uv, counts, file.name);
  const bool other_pictures =
      header.pictures.size() == 1 &&
      std::ranges::any_of(reader.polygons.pictures, [](uint32_t n) { return n != 0; });
  reader.polygons = {};
  const std::vector<int> materials =
      show_pictures(header, file, lists.size(), !reader.vertices.uv.empty(), scene);
  if (other_pictures && materials[0] >= 0)
    scene.warnings.emplace_back(
        "faces have a texnumber other than 0, but there is one picture: they show it");
  if (reader.transparent > 0)
    scene.warnings.emplace_back(
        "the transparency of colours (alpha) was left out: give the mesh a `material` with `alpha`");
  const auto has_material = [](const PlyElement& element) {
    return std::ranges::count(element.properties, "material_index", &PlyProperty::name) > 0;
  };
  if (std::ranges::any_of(header.elements, has_material))
    scene.warnings.emplace_back("its materials (material_index) were left out: give the mesh a `material`");
  MeshBuilder builder(reader.vertices, counts);
  for (size_t i = 0; i < lists.size(); ++i) {
    if (lists.size() > 1 && lists[i].positions.empty()) continue;
    scene.instances.push_back({static_cast<int>(scene.meshes.size()), Mat4(1.0), materials[i], {}});
    scene.meshes.push_back(builder.build(lists[i], file.options.smooth.value_or(default_smooth)));
  }
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

}  // namespace eyeray::engine::importers
