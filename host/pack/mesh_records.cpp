#include "host/pack/mesh_records.hpp"

#include "host/core/parallel_for.hpp"

namespace eyeray::engine::pack {

bvh::Box triangle_box(const shader::Primitive& triangle) {
  bvh::Box box;
  for (const shader::vec4& corner : {triangle.a, triangle.b, triangle.c}) box.include(glm::vec3(corner));
  return box;
}

MeshRecords::MeshRecords(const Mesh& mesh, const Affine& map, const Vec3& origin, int material,
                         uint32_t optical_depth, uint32_t first_id, bool bends,
                         RawVector<shader::uvec4>& vertices)
    : mesh_(&mesh), map_(map), origin_(origin), mirrored_(map.mirrors()) {
  const bool normals = !mesh.normals.empty();
  const bool uv = !mesh.uv.empty();
  const bool colors = !mesh.colors.empty();
  first_ = records::Packer::primitive(shader::KIND_triangle, material, {}, {}, {});
  first_.id = first_id;
  first_.optical_depth = optical_depth;
  const bool tangents = bends && !mesh.tangents.empty();
  const bool second_uv = !mesh.second_uv.empty();
  if (!normals && !uv && !second_uv && !colors && !bends) return;

  // The values that corners look up, and the corners of each triangle.
  const auto first_vertex = uint32_t(vertices.size());
  const uint32_t beside_normal = colors ? 2 : 1;
  const uint32_t vertex_records = beside_normal + (second_uv ? 1 : 0) + (tangents ? 1 : 0);
  const auto first_corners = uint32_t(first_vertex + mesh.positions.size() * vertex_records);
  first_.extra = first_corners;
  const uint32_t gradients = uv ? 2 : 1;
  corner_records_ = gradients + (bends ? second_uv ? 4 : 2 : 0);
  const CornerNormals map_normal(map);
  vertices.resize(first_corners + mesh.triangles.size() * corner_records_);
  parallel_for(0, int(mesh.positions.size()), [&](int i) {
    const Vec3 normal = normals ? map_normal(mesh.normals[size_t(i)]) : Vec3(0);
    shader::uvec4* vertex = &vertices[first_vertex + size_t(i) * vertex_records];
    vertex[0] = records::to_bits(records::to_vec4(normal, uv ? mesh.uv[size_t(i)].x : 0.0));
    if (colors)
      vertex[1] = records::to_bits(
          records::to_vec4(mesh.colors[size_t(i)], mesh.alphas.empty() ? 1 : mesh.alphas[size_t(i)]));
    if (second_uv) {
      const Vec2& second = mesh.second_uv[size_t(i)];
      vertex[beside_normal] = records::to_bits(records::to_vec4({second.x, second.y, 0}));
    }
    if (tangents) {
      const Vec4& tangent = mesh.tangents[size_t(i)];
      vertex[vertex_records - 1] = records::to_bits(
          records::to_vec4(unit(map.linear * Vec3(tangent)), mirrored_ ? -tangent.w : tangent.w));
    }
  });
  parallel_for(0, int(mesh.triangles.size()), [&](int i) {
    const auto& [v0, v1, v2] = mesh.triangles[size_t(i)];
    shader::uvec4* corners = &vertices[first_corners + size_t(i) * corner_records_];
    corners[0] = {first_vertex + v0 * vertex_records, first_vertex + v1 * vertex_records,
                  first_vertex + v2 * vertex_records,
                  (normals ? CORNERS_NORMALS : 0u) | (uv ? CORNERS_UV : 0u) | (colors ? CORNERS_COLORS : 0u) |
                      (bends ? CORNERS_GRADIENTS : 0u) | (tangents ? CORNERS_TANGENTS : 0u) |
                      (second_uv ? CORNERS_SECOND_UV : 0u) |
                      (tangents && mesh.second_tangents ? CORNERS_SECOND_TANGENTS : 0u)};
    if (uv) corners[1] = records::to_bits(records::to_vec4({mesh.uv[v0].y, mesh.uv[v1].y, mesh.uv[v2].y}));
    if (!bends) return;
    const auto add_gradients = [&](shader::uvec4* to, const std::array<Vec2, 3>& at) {
      const UvGradients grow = uv_gradients(this->corners(uint32_t(i)), at);
      to[0] = records::to_bits(records::to_vec4(grow.u));
      to[1] = records::to_bits(records::to_vec4(grow.v));
    };
    const auto at_corners = [&mesh, i](const std::vector<Vec2>& of) {
      const auto& corner = mesh.triangles[size_t(i)];
      return std::array{of[corner[0]], of[corner[1]], of[corner[2]]};
    };
    add_gradients(corners + gradients, uv ? at_corners(mesh.uv) : corner_weights);
    if (second_uv) add_gradients(corners + gradients + 2, at_corners(mesh.second_uv));
  });
}

shader::Primitive MeshRecords::record(uint32_t triangle) const {
  const Corners at = corners(triangle);
  const Vec3 outward = mirrored_ ? -geometric_normal(at) : geometric_normal(at);
  shader::Primitive record = first_;
  record.id += triangle;
  record.extra += triangle * corner_records_;
  record.a = records::to_vec4(at[0] - origin_, outward.x);
  record.b = records::to_vec4(at[1] - origin_, outward.y);
  record.c = records::to_vec4(at[2] - origin_, outward.z);
  return record;
}

bvh::Box MeshRecords::box(uint32_t triangle) const {
  bvh::Box box;
  for (const Vec3& corner : corners(triangle)) box.include(glm::vec3(corner - origin_));
  return box;
}

Corners MeshRecords::corners(uint32_t triangle) const {
  const auto& [v0, v1, v2] = mesh_->triangles[triangle];
  return {map_.point(mesh_->positions[v0]), map_.point(mesh_->positions[v1]),
          map_.point(mesh_->positions[v2])};
}

}  // namespace eyeray::engine::pack
