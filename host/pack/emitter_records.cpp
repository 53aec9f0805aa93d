#include "host/pack/emitter_records.hpp"

#include <cmath>

namespace eyeray::pack {
namespace {

// How many roundings, of the largest coordinate, a place on an emitter may be off it (emitters/*.glsl).
constexpr double roundings = 16;

double most_of(const Vec3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

// A record's kind, a, b and c.
class Fields {
 public:
  Fields(const records::Packer& packer, shader::Emitter& record) : packer_(packer), record_(record) {}

  void operator()(const SphereForm& sphere) {
    set(shader::EMITTER_sphere, sphere.center, sphere.radius, sphere.radius);
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
    set_with_edges(shader::EMITTER_parallelogram, it.corner, 0, it.edge_u, it.edge_v);
  }

 private:
  // `size`: how far the emitter reaches from `place`.
  void set(uint32_t kind, const Vec3& place, double w, double size) {
    record_.kind = kind;
    record_.a = records::to_vec4(packer_.relative(place), w);
    record_.offset = float(roundings * 0x1p-24 * (most_of(packer_.relative(place)) + size));
  }
  void set_with_edges(uint32_t kind, const Vec3& place, double w, const Vec3& b, const Vec3& c) {
    set(kind, place, w, most_of(b) + most_of(c));
    record_.b = records::to_vec4(b);
    record_.c = records::to_vec4(c);
  }

  const records::Packer& packer_;
  shader::Emitter& record_;
};

}  // namespace

void pack_light_choice(const LightChoice& choice, records::Packer& packer) {
  for (size_t i = 0; i < choice.ends.size(); ++i) {
    shader::Emitter record{};
    record.end = choice.ends[i];
    if (const size_t lights = choice.ends.size() - choice.emitters.size(); i >= lights) {
      const Emitter& emitter = choice.emitters[i - lights];
      std::visit(Fields(packer, record), emitter.form);
      record.radiance = glm::vec3(emitter.radiance);
      record.primitive = uint32_t(emitter.primitive);
      record.area = float(emitter.area);
    }
    packer.scene.emitters.push_back(record);
  }
}

}  // namespace eyeray::pack
