#include "host/pack/emitter_records.hpp"

#include <cmath>

namespace eyeray::engine::pack {
namespace {

// The largest distance of a sampled point from its emitter, in roundings of the largest coordinate
// (emitters/*.glsl).
constexpr double roundings = 16;

double most_of(const Vec3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

// Fills in a record's kind, a, b and c.
class Fields {
 public:
  Fields(const records::Packer& packer, shader::Emitter& record) : packer_(packer), record_(record) {}

  void operator()(const SphereForm& sphere) {
    set(shader::EMITTER_sphere, sphere.center, sphere.radius, sphere.radius);
    record_.b = records::to_vec4(sphere.axes[1]);
    record_.c = records::to_vec4(sphere.axes[0], glm::determinant(sphere.axes) < 0 ? -1 : 1);
  }
  void operator()(const DiskForm& disk) {
    set_with_edges(shader::EMITTER_disk, Vec3(disk.to_world[3]), disk.inner * disk.inner,
                   Vec3(disk.to_world[0]), Vec3(disk.to_world[2]));
  }
  void operator()(const TriangleForm& triangle) {
    const auto& [a, b, c] = triangle.vertices;
    set_with_edges(shader::EMITTER_triangle, a, 0, b - a, c - a);
  }
  void operator()(const ParallelogramForm& it) {
    const bool right = is_rectangle(it);
    set_with_edges(right ? shader::EMITTER_rectangle : shader::EMITTER_parallelogram, it.corner, 0, it.edge_u,
                   it.edge_v);
    if (!right) return;
    record_.b.w = float(glm::length(it.edge_u));
    record_.c.w = float(glm::length(it.edge_v));
  }
  void operator()(const BoxForm& it) { set_map(shader::EMITTER_box, it.to_world); }
  void operator()(const EllipsoidForm& it) { set_map(shader::EMITTER_ellipsoid, it.to_world); }
  void operator()(const CylinderForm& it) {
    set_map(shader::EMITTER_cylinder, it.to_world);
    record_.area = float(share_of_side(it));
  }

 private:
  void set_map(uint32_t kind, const Mat4& m) {
    const Vec3 center = packer_.relative(Vec3(m[3]));
    set(kind, Vec3(m[3]), 0, 2 * (most_of(Vec3(m[0])) + most_of(Vec3(m[1])) + most_of(Vec3(m[2]))));
    for (int row = 0; row < 3; ++row)
      (row == 0   ? record_.a
       : row == 1 ? record_.b
                  : record_.c) = records::to_vec4({m[0][row], m[1][row], m[2][row]}, center[row]);
  }
  // `size`: how far the emitter reaches from `point`.
  void set(uint32_t kind, const Vec3& point, double w, double size) {
    record_.kind = kind;
    record_.a = records::to_vec4(packer_.relative(point), w);
    record_.offset = float(roundings * 0x1p-24 * (most_of(packer_.relative(point)) + size));
  }
  void set_with_edges(uint32_t kind, const Vec3& point, double w, const Vec3& b, const Vec3& c) {
    set(kind, point, w, most_of(b) + most_of(c));
    record_.b = records::to_vec4(b);
    record_.c = records::to_vec4(c);
  }

  const records::Packer& packer_;
  shader::Emitter& record_;
};

uint32_t add_corners(const EmitterCorners& at, const shader::Texture& texture, records::Packer& packer) {
  const auto& uv = reads_second_uv(texture) ? at.second_uv : at.uv;
  const auto vertex = [&](size_t i) { return records::to_bits(records::to_vec4(at.colors[i], uv[i].x)); };
  return packer.add_vertices(
      {vertex(0), vertex(1), vertex(2), records::to_bits(records::to_vec4({uv[0].y, uv[1].y, uv[2].y}))});
}

shader::LightNode pack_node(const LightBvh::Node& node, const records::Packer& packer) {
  const LightBounds& bounds = node.bounds;
  return {.center = glm::vec3(packer.relative(bounds.center)),
          .radius = float(bounds.radius * (1 + 1e-6)),
          .axis = glm::vec3(bounds.axis),
          .power = float(bounds.power),
          .cos_spread = float(std::cos(bounds.spread)),
          .cos_reach = float(std::cos(bounds.reach)),
          .child = node.child | (node.leaf ? LEAF : 0),
          .both_sides = bounds.both_sides};
}

}  // namespace

void pack_light_choice(const LightChoice& choice, records::Packer& packer) {
  for (size_t i = 0; i < choice.ends.size(); ++i) {
    shader::Emitter record{};
    record.texture = record.corners = NONE;
    record.end = choice.ends[i];
    record.trail = choice.bvh.nodes.empty() ? NONE : choice.bvh.trails[i];
    if (const size_t lights = choice.ends.size() - choice.emitters.size(); i >= lights) {
      const Emitter& emitter = choice.emitters[i - lights];
      record.area = float(emitter.area);
      std::visit(Fields(packer, record), emitter.form);
      record.radiance = glm::vec3(emitter.radiance);
      record.primitive = uint32_t(emitter.primitive);
      record.side = float(emitter.side);
      if (emitter.varies) record.texture = packer.scene.materials[size_t(emitter.material)].emission;
      if (emitter.corners)
        record.corners = add_corners(*emitter.corners, packer.scene.textures[record.texture], packer);
    }
    packer.scene.emitters.push_back(record);
  }
  for (const LightBvh::Node& node : choice.bvh.nodes)
    packer.scene.light_nodes.push_back(pack_node(node, packer));
}

}  // namespace eyeray::engine::pack
