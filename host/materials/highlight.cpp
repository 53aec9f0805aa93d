#include "materials/highlight.hpp"

#include <cmath>

namespace eyeray {

void Highlight::apply(const Vec2& uv, Scattering& scattering) const {
  scattering.specular = specular.at(uv);
  scattering.shininess = shininess;
  scattering.blinn = blinn;
}

Highlight read_highlight(const TableReader& table) {
  return {table.texture("specular"), table.number("shininess"), table.choice("highlight") == 1};
}

// −log2 of the share, in SHADOW_SCALE-ths: an integer, so that the sum over surfaces does not depend on their
// order.
static uint32_t shadow_density(double transmittance) {
  const double density = std::round(-std::log2(transmittance) * double(SHADOW_SCALE));
  return density < double(SHADOW_OPAQUE) ? uint32_t(density) : SHADOW_OPAQUE;
}

shader::Material make_record(uint32_t kind, const Highlight& highlight, double shadow_transmittance,
                             Packer& packer) {
  const uint32_t black = packer.add_texture({});
  const uint32_t flags = (highlight.blinn ? MATERIAL_BLINN : 0u) | black << MATERIAL_EMISSION_SHIFT;
  return {.head = {kind, flags, 0u, shadow_density(shadow_transmittance)},
          .textures = {black, packer.add_texture(highlight.specular), black, black},
          .parameters = shader::vec4(float(highlight.shininess), 0.0f, 0.0f, 0.0f),
          .mask = {}};
}

}  // namespace eyeray
