#include "host/executors/scene_constants.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "host/executors/registry_text.hpp"

namespace eyeray::engine::executors {
namespace {

// Above this many records of a kind the code costs more than it saves, and its compilation more than a frame
// saves.
constexpr size_t most_records = 24;
constexpr size_t most_vertices_of_primitive = 4;

std::string literal(float x) {
  return fmt::format("{:.9e}", x);
}
std::string literal(uint32_t x) {
  return fmt::format("{}u", x);
}
// Text that is GLSL already.
std::string literal(std::string_view text) {
  return std::string(text);
}
std::string literal(const shader::vec4& v) {
  return fmt::format("vec4({}, {}, {}, {})", literal(v.x), literal(v.y), literal(v.z), literal(v.w));
}
std::string literal(const shader::vec2& v) {
  return fmt::format("vec2({}, {})", literal(v.x), literal(v.y));
}
std::string literal(const shader::vec3& v) {
  return fmt::format("vec3({}, {}, {})", literal(v.x), literal(v.y), literal(v.z));
}
std::string literal(const shader::uvec4& v) {
  return fmt::format("uvec4({}, {}, {}, {})", literal(v.x), literal(v.y), literal(v.z), literal(v.w));
}
// A record of these members, in their order.
template <typename... Members>
std::string record_literal(std::string_view type, const Members&... members) {
  return fmt::format("{}({})", type, fmt::join(std::array{literal(members)...}, ", "));
}
std::string literal(const shader::Primitive& p) {
  return record_literal("Primitive", p.id, p.material_and_kind, p.optical_depth, p.extra, p.a, p.b, p.c);
}
std::string literal(const shader::Material& m) {
  return record_literal(
      "Material", m.kind, m.flags, m.medium, m.optical_depth, m.base, m.specular, m.reflected, m.ambient,
      m.emission, m.alpha, m.alpha_cutoff, m.shininess, m.a, m.color, m.roughness, m.metallic, m.coat, m.b,
      m.c, m.coat_roughness, m.specular_level, m.transmission, m.specular_color, m.sheen, m.sheen_roughness,
      m.normal_map, m.normal_scale, m.bump, m.bump_height, m.bump_width, m.coat_normal, m.coat_normal_scale,
      m.diffuse_transmission, m.diffuse_transmission_color, m.anisotropy, m.anisotropy_direction,
      m.anisotropy_turn, m.iridescence, m.iridescence_thickness, m.iridescence_least, m.iridescence_most,
      m.iridescence_ior, m.unused);
}
std::string literal(const shader::Texture& t) {
  return record_literal("Texture", t.color, t.kind, t.a, t.b, t.c);
}
std::string literal(const shader::Medium& m) {
  return record_literal("Medium", m.absorption, m.ior, m.scattering, m.anisotropy, m.spread, 0.0f, 0.0f,
                        0.0f);
}
std::string literal(const shader::Light& l) {
  return record_literal("Light", l.intensity, l.kind, l.a, l.b);
}
std::string literal(const shader::Emitter& e) {
  return record_literal("Emitter", e.radiance, e.kind, e.a, e.b, e.c, e.primitive, e.end, e.area, e.offset,
                        e.trail, e.texture, e.corners, e.side);
}
// The seed comes from the buffer: another one needs no other kernel.
std::string literal(const shader::Frame& f) {
  return record_literal(
      "Frame", f.width, f.height, std::string_view("FRAME_SEED"), f.samples_per_side, f.camera, f.pattern,
      f.media, f.max_depth, f.light_count, f.loop_probe, f.integrator, f.triangle_method, f.right,
      f.min_throughput, f.up, f.pixel_width, f.forward, f.pixel_height, f.background, f.emitter_count,
      f.ambient, f.aperture, f.sharpness, f.blade_rotation, f.blades, f.pixel_filter, f.environment_width,
      f.environment_height, f.environment_numbers, f.environment_turn, f.filter_width, f.light_bvh_numbers,
      f.camera_formula, f.has_medium_extent, f.medium_min, f.medium_decay, f.medium_max, f.medium_base);
}

// A loader that chooses among constants. A driver that runs both sides of every branch selects between
// registers faster than it gathers from memory. If all records agree, no selection remains.
template <typename Records>
std::string constant_loader(std::string_view type, std::string_view name, const Records& records) {
  std::string text = fmt::format("{0} load_{1}(uint i) {{\n  {0} r = {2};\n", type, name,
                                 literal(records.empty() ? typename Records::value_type{} : records[0]));
  for (size_t i = 1; i < records.size(); ++i)
    text += fmt::format("  if (i == {}u) r = {};\n", i, literal(records[i]));
  return text + "  return r;\n}\n";
}

}  // namespace

bool few_shading_records(const records::PackedScene& scene) {
  return std::max({scene.materials.size(), scene.textures.size(), scene.media.size(), scene.lights.size(),
                   scene.emitters.size()}) <= most_records;
}

bool few_primitives(const records::PackedScene& scene) {
  return !scene.has_bvh && scene.instances.empty() && scene.leaf_uses.empty() &&
         scene.primitives.size() <= scene.most_linear &&
         scene.vertices.size() <= most_vertices_of_primitive * scene.most_linear;
}

std::string shading_as_constants(const records::PackedScene& scene,
                                 const std::set<uint32_t>& materials_used) {
  std::string text = constant_loader("Material", "material", scene.materials) +
                     constant_loader("Texture", "texture", scene.textures) +
                     constant_loader("Medium", "medium", scene.media) +
                     constant_loader("Light", "light", scene.lights) +
                     constant_loader("Emitter", "emitter", scene.emitters) + "#define SHADING_AS_CONSTANTS\n";
  if (scene.texel_count > 0) return text;
  text += "#define SCENE_MATERIALS(X)";
  for (const uint32_t i : materials_used) {
    const auto row = std::ranges::find(rows::materials, scene.materials[i].kind, &Row::number);
    text += fmt::format(" X({0}, {1}u, load_material({1}u))", row->name, i);
  }
  return text + "\n";
}

std::string frame_as_constant(const shader::Frame& f) {
  return fmt::format("Frame load_frame() {{ return {}; }}\n#define FRAME_AS_CONSTANT\n", literal(f));
}

std::string primitives_as_constants(const records::PackedScene& scene) {
  std::string text = constant_loader("uvec4", "vertex", scene.vertices) +
                     constant_loader("Primitive", "primitive", scene.primitives) +
                     "#define SCENE_PRIMITIVES(X)";
  std::multimap<uint32_t, size_t> by_id;  // slots by primitives' ids
  for (size_t i = 0; i < scene.primitives.size(); ++i) by_id.emplace(scene.primitives[i].id, i);
  for (const auto& [id, i] : by_id)
    text += fmt::format(" X({}, {}u, load_primitive({}u))", rows::shapes[kind_of(scene.primitives[i])].name,
                        i, i);
  return text + "\n";
}

}  // namespace eyeray::engine::executors
