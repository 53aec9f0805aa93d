#include "host/pack/albedo_records.hpp"

#include "host/tables/albedos.hpp"

namespace eyeray::engine::pack {

static_assert(tables::ggx_side == GGX_ALBEDOS && tables::sheen_side == SHEEN_ALBEDOS &&
              tables::glass_side == GLASS_ALBEDOS && tables::glass_slices == GLASS_SLICES &&
              tables::glass_slices_below == GLASS_SLICES_BELOW);
static_assert(FIRST_SHEEN_ALBEDO == GGX_ALBEDOS * GGX_ALBEDOS &&
              FIRST_GLASS_ALBEDO == FIRST_SHEEN_ALBEDO + SHEEN_ALBEDOS * SHEEN_ALBEDOS &&
              END_OF_ALBEDOS == FIRST_GLASS_ALBEDO + GLASS_SLICES * GLASS_ALBEDOS * GLASS_ALBEDOS);

void pack_albedos(records::PackedScene& packed) {
  const auto has = [&](uint32_t lobe) { return packed.lobes.contains(lobe); };
  std::vector<shader::vec4>& albedos = packed.albedos;
  if (has(shader::LOBE_glossy))
    for (const optics::GgxAlbedo& of : tables::ggx_albedos())
      albedos.emplace_back(1 - of.once, of.edge, 1 - of.mean_once, of.mean_edge);
  if (has(shader::LOBE_sheen)) {
    albedos.resize(FIRST_SHEEN_ALBEDO);
    for (const optics::SheenAlbedo& of : tables::sheen_albedos())
      albedos.emplace_back(of.unweakened, of.albedo, 0, 0);
  }
  if (has(shader::LOBE_rough_glass)) {
    albedos.resize(FIRST_GLASS_ALBEDO);
    for (int slice = 0; slice < tables::glass_slices; ++slice) {
      const auto begin = tables::glass_albedos(slice), end = tables::glass_albedos(slice + 1);
      for (size_t i = 0; i < begin.size(); ++i) albedos.emplace_back(begin[i], end[i], 0, 0);
    }
  }
}

}  // namespace eyeray::engine::pack
