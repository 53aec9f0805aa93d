#include "host/materials/highlight.hpp"

#include <cmath>

#include "host/materials/registry.hpp"

namespace eyeray::engine::materials {

void Highlight::apply(const TextureContext& point, Scattering& scattering) const {
  scattering.specular = specular->at(point);
  scattering.shininess = shininess;
  scattering.blinn = blinn;
}

Highlight read_highlight(const TableReader& table) {
  return {table.texture("specular"), table.number("shininess"), table.choice("highlight") == 1};
}

// −log2 of the transmittance, in units of 1 / OPTICAL_DEPTH_SCALE. It is an integer, so that the sum over
// surfaces does not depend on their order.
static uint32_t optical_depth_of(double transmittance) {
  const double optical_depth = std::round(-std::log2(transmittance) * double(OPTICAL_DEPTH_SCALE));
  return optical_depth < double(OPTICAL_DEPTH_OPAQUE) ? uint32_t(optical_depth) : OPTICAL_DEPTH_OPAQUE;
}

shader::Material make_record(uint32_t kind, const Highlight& highlight, double shadow_transmittance,
                             records::Packer& packer) {
  const uint32_t black = textures::make_constant(Vec3(0))->pack(packer);
  return {.kind = kind,
          .flags = highlight.blinn ? MATERIAL_BLINN : 0u,
          .medium = 0,
          .optical_depth = optical_depth_of(shadow_transmittance),
          .base = black,
          .specular = highlight.specular->pack(packer),
          .reflected = black,
          .ambient = black,
          .emission = black,
          .alpha = black,
          .alpha_cutoff = 0,
          .shininess = float(highlight.shininess),
          .a = shader::vec4(0),
          .color = black,
          .roughness = black,
          .metallic = black,
          .coat = black,
          .b = shader::vec4(0),
          .c = shader::vec3(0),
          .coat_roughness = black,
          .specular_level = black,
          .transmission = black,
          .specular_color = black,
          .sheen = black,
          .sheen_roughness = black,
          .normal_map = NONE,
          .normal_scale = 0,
          .bump = NONE,
          .bump_height = 0,
          .bump_width = 0,
          .coat_normal = NONE,
          .coat_normal_scale = 0,
          .diffuse_transmission = black,
          .diffuse_transmission_color = black,
          .anisotropy = black,
          .anisotropy_direction = NONE,
          .anisotropy_turn = shader::vec2(1, 0),
          .iridescence = black,
          .iridescence_thickness = black,
          .iridescence_least = 0,
          .iridescence_most = 0,
          .iridescence_ior = 1,
          .unused = 0};
}

}  // namespace eyeray::engine::materials
