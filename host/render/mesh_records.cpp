#include "render/mesh_records.hpp"

#include "core/parallel_for.hpp"
#include "scene/triangle.hpp"

namespace eyeray {
namespace {

// Unit, and outward where the mesh's own is.
Vec3 outward_normal(const Corners& corners, const Affine& map) {
  const Vec3 normal = geometric_normal(corners);
  return map.mirrors() ? -normal : normal;
}

}  // namespace

std::vector<shader::Primitive> mesh_records(const Mesh& mesh, const Affine& map, const Vec3& origin,
                                            int material, uint32_t first_id,
                                            std::vector<shader::uvec4>& vertices) {
  const bool normals = !mesh.normals.empty();
  const bool uv = !mesh.uv.empty();
  const bool colors = !mesh.colors.empty();
  const bool any = normals || uv || colors;
  const auto first_vertex = uint32_t(vertices.size());
  const uint32_t vertex_records = colors ? 2 : 1;
  const auto first_corners = uint32_t(first_vertex + mesh.positions.size() * vertex_records);
  const uint32_t corner_records = uv ? 2 : 1;
  if (any) {
    vertices.resize(first_corners + mesh.triangles.size() * corner_records);
    parallel_for(0, int(mesh.positions.size()), [&](int i) {
      const Vec3 normal = normals ? map.normal(mesh.normals[size_t(i)]) : Vec3(0);
      const size_t record = first_vertex + size_t(i) * vertex_records;
      vertices[record] = to_bits(to_vec4(normal, uv ? mesh.uv[size_t(i)].x : 0.0));
      if (colors) vertices[record + 1] = to_bits(to_vec4(mesh.colors[size_t(i)]));
    });
  }

  std::vector<shader::Primitive> records(mesh.triangles.size());
  parallel_for(0, int(mesh.triangles.size()), [&](int i) {
    const auto& [v0, v1, v2] = mesh.triangles[size_t(i)];
    const Corners corners{map.point(mesh.positions[v0]), map.point(mesh.positions[v1]),
                          map.point(mesh.positions[v2])};
    const Vec3 normal = outward_normal(corners, map);
    uint32_t extra = NONE;
    if (any) {
      extra = first_corners + uint32_t(i) * corner_records;
      vertices[extra] = {
          first_vertex + v0 * vertex_records, first_vertex + v1 * vertex_records,
          first_vertex + v2 * vertex_records,
          (normals ? CORNERS_NORMALS : 0u) | (uv ? CORNERS_UV : 0u) | (colors ? CORNERS_COLORS : 0u)};
      if (uv) vertices[extra + 1] = to_bits(to_vec4({mesh.uv[v0].y, mesh.uv[v1].y, mesh.uv[v2].y}));
    }
    shader::Primitive& record = records[size_t(i)];
    record.head = Packer::head(shader::KIND_triangle, material, extra);
    record.head.x = first_id + uint32_t(i);
    record.a = to_vec4(corners[0] - origin, normal.x);
    record.b = to_vec4(corners[1] - origin, normal.y);
    record.c = to_vec4(corners[2] - origin, normal.z);
  });
  return records;
}

}  // namespace eyeray
