#include "host/importers/mesh_builder.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/image/srgb.hpp"
#include "host/importers/smooth.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/triangle.hpp"

namespace eyeray::engine::importers {

namespace {

// A new vertex is compared with at most this many vertices at its position, which may differ in normal or
// uv. If there are more, some vertices are made twice, but importing takes no longer.
constexpr int most_compared = 8;

// Limit on the triangles of a mesh: their corners are counted in 32 bits.
constexpr size_t most_triangles = size_t{1} << 30;

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// True if the uv are in range, which is that of all coordinates.
bool usable(const Vec2& uv) {
  return std::fabs(uv.x) <= max_coordinate && std::fabs(uv.y) <= max_coordinate;
}

std::string counted(size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace

Vec3 sound_color(const Vec3& rgb) {
  const auto sound = [](double x) { return x > 0 ? std::min(x, 1.0) : 0.0; };
  return {sound(rgb.x), sound(rgb.y), sound(rgb.z)};
}

Vec3 color_from_display(const Vec3& rgb) {
  // Use a table for codes of 8 bits: nearly all colours are such codes, and a power takes its time.
  static const std::vector<double> codes = [] {
    std::vector<double> table;
    for (int code = 0; code < 256; ++code) table.push_back(image::linear_from_srgb(code / 255.0));
    return table;
  }();
  const auto linear = [](double value) {
    const double code = value * 255;
    return code == std::floor(code) ? codes[static_cast<size_t>(code)] : image::linear_from_srgb(value);
  };
  const Vec3 sound = sound_color(rgb);
  return {linear(sound.x), linear(sound.y), linear(sound.z)};
}

void MeshCounts::report(std::vector<std::string>& warnings) const {
  const auto add = [&](size_t count, std::string_view one, std::string_view many) {
    if (count > 0) warnings.push_back(counted(count, one, many));
  };
  add(not_finite, "face with a coordinate that is not finite was left out",
      "faces with coordinates that are not finite were left out");
  add(without_area, "face without area was left out", "faces without area were left out");
  add(bad_normals, "corner whose normal has no direction or points inward got that of its face",
      "corners whose normals have no direction or point inward got those of their faces");
  add(bad_uv, "corner whose uv is not finite or beyond 1e12 got uv 0",
      "corners whose uv are not finite or beyond 1e12 got uv 0");
  add(fans, "concave face has too many corners and was cut as if it were convex",
      "concave faces have too many corners and were cut as if they were convex");
}

MeshBuilder::MeshBuilder(VertexPool& pool, MeshCounts& counts) : pool_(pool), counts_(counts) {
  for (Vec3& normal : pool.normals) {
    const double size = magnitude(normal);
    normal = finite(normal) && size > 0 ? unit(normal) : Vec3(0);
  }
  last_.resize(pool.positions.size());
  mesh_.resize(pool.positions.size(), 0);
}

// The unit normals of faces; 0 for faces to leave out.
std::vector<Vec3> MeshBuilder::face_normals(const RawTriangles& raw) {
  std::vector<Vec3> normals(raw.positions.size());
  const auto corners = [&](size_t face) {
    Corners c;
    for (size_t i = 0; i < 3; ++i) c[i] = pool_.positions[raw.positions[face][i]];
    return c;
  };
  parallel_for(0, static_cast<int>(normals.size()), [&](int i) {
    const auto face = static_cast<size_t>(i);
    const Corners c = corners(face);
    if (thickness(c) >= thinnest_triangle) normals[face] = geometric_normal(c);
  });
  for (size_t face = 0; face < normals.size(); ++face) {
    if (normals[face] != Vec3(0) && finite(normals[face])) continue;
    normals[face] = Vec3(0);
    const Corners c = corners(face);
    ++(finite(c[0]) && finite(c[1]) && finite(c[2]) ? counts_.without_area : counts_.not_finite);
  }
  return normals;
}

// True if both make the same vertex. Texture coordinates and colours may belong to single faces, so their
// values are compared.
bool MeshBuilder::is_same(const Source& a, const Source& b) const {
  const auto same = [](const auto& values, uint32_t i, uint32_t k) {
    return i == k || (i != no_index && k != no_index && values[i] == values[k]);
  };
  return a.position == b.position && a.normal == b.normal && same(pool_.uv, a.uv, b.uv) &&
         same(pool_.colors, a.color, b.color);
}

// The mesh's vertex that was made from `source`; no_index if none is found.
uint32_t MeshBuilder::find_vertex(const Source& source) {
  if (mesh_[source.position] != meshes_) return no_index;
  uint32_t vertex = last_[source.position];
  for (int i = 0; i < most_compared && vertex != no_index; ++i) {
    if (is_same(sources_[vertex], source)) return vertex;
    vertex = next_[vertex];
  }
  return no_index;
}

void MeshBuilder::append(Mesh& mesh, const RawTriangles& raw, const Source& source, const Vec3& normal) {
  const auto vertex = static_cast<uint32_t>(sources_.size());
  next_.push_back(mesh_[source.position] == meshes_ ? last_[source.position] : no_index);
  last_[source.position] = vertex;
  mesh_[source.position] = meshes_;
  sources_.push_back(source);

  mesh.positions.push_back(pool_.positions[source.position]);
  if (raw.has_normals) mesh.normals.push_back(normal);
  if (raw.has_uv) mesh.uv.push_back(source.uv == no_index ? Vec2(0) : pool_.uv[source.uv]);
  if (!pool_.colors.empty()) mesh.colors.push_back(pool_.colors[source.color]);
  if (!pool_.alphas.empty()) mesh.alphas.push_back(pool_.alphas[source.position]);
  if (!pool_.second_uv.empty()) {
    const Vec2& second = pool_.second_uv[source.position];
    mesh.second_uv.push_back(usable(second) ? second : Vec2(0));
  }
  if (!pool_.tangents.empty()) {
    const Vec4& tangent = pool_.tangents[source.position];
    mesh.tangents.emplace_back(unit(Vec3(tangent)), tangent.w);
  }
}

Mesh MeshBuilder::build(const RawTriangles& raw, double smooth) {
  if (raw.positions.size() > most_triangles) {
    throw Error(ExitCode::bad_input, "{} has {} triangles; a mesh has at most {}", raw.name,
                raw.positions.size(), most_triangles);
  }
  ++meshes_;
  sources_.clear();
  next_.clear();
  const std::vector<Vec3> faces = face_normals(raw);

  Mesh mesh;
  mesh.name = raw.name;
  mesh.triangles.reserve(faces.size());
  std::vector<Vec3> kept;  // the normals of the mesh's triangles
  kept.reserve(faces.size());
  for (size_t face = 0; face < faces.size(); ++face) {
    if (faces[face] == Vec3(0)) continue;
    IndexTriangle triangle;
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t position = raw.positions[face][i];
      const uint32_t color = !raw.corner_colors.empty() ? raw.corner_colors[face][i]
                             : raw.colors.empty()       ? position
                                                        : raw.colors[face];
      Source source{position, no_index, no_index, color};

      // A corner whose normal cannot be used gets the face's normal, and a vertex that no other face shares.
      Vec3 normal = faces[face];
      if (raw.has_normals) {
        const uint32_t written = raw.normals.empty() ? position : raw.normals[face][i];
        if (written != no_index && glm::dot(pool_.normals[written], faces[face]) > least_normal_cosine) {
          source.normal = written;
          normal = pool_.normals[written];
        } else if (written != no_index) {
          ++counts_.bad_normals;
        }
      }
      if (raw.has_uv) {
        source.uv = raw.uv.empty() ? position : raw.uv[face][i];
        if (source.uv != no_index && !usable(pool_.uv[source.uv])) {
          source.uv = no_index;
          ++counts_.bad_uv;
        }
      }
      if (!pool_.second_uv.empty() && !usable(pool_.second_uv[position])) ++counts_.bad_uv;
      const bool own = raw.has_normals && source.normal == no_index;
      triangle[i] = own ? no_index : find_vertex(source);
      if (triangle[i] == no_index) {
        triangle[i] = static_cast<uint32_t>(sources_.size());
        append(mesh, raw, source, normal);
      }
    }
    mesh.triangles.push_back(triangle);
    kept.push_back(faces[face]);
  }
  if (!raw.has_normals && smooth > 0) add_smooth_normals(mesh, kept, smooth);
  return mesh;
}

}  // namespace eyeray::engine::importers
