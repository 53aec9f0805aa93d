#include "host/pack/albedo_records.hpp"

#include <set>
#include <vector>

#include "host/core/parallel_for.hpp"
#include "host/optics/ggx_albedo.hpp"
#include "host/optics/glass_albedo.hpp"
#include "host/optics/sheen_albedo.hpp"

namespace eyeray::pack {

static_assert(optics::ggx_albedos == GGX_ALBEDOS && optics::sheen_albedos == SHEEN_ALBEDOS &&
              optics::glass_albedos == GLASS_ALBEDOS && optics::glass_slices == GLASS_SLICES);
static_assert(FIRST_SHEEN_ALBEDO == GGX_ALBEDOS * GGX_ALBEDOS &&
              FIRST_GLASS_ALBEDO == FIRST_SHEEN_ALBEDO + SHEEN_ALBEDOS * SHEEN_ALBEDOS &&
              END_OF_ALBEDOS == FIRST_GLASS_ALBEDO + GLASS_SLICES * GLASS_ALBEDOS * GLASS_ALBEDOS);

void pack_albedos(records::PackedScene& packed) {
  const auto has = [&](uint32_t lobe) { return packed.lobes.contains(lobe); };
  if (has(shader::LOBE_glossy)) {
    packed.albedos.resize(FIRST_SHEEN_ALBEDO);
    for (size_t i = 0; i < FIRST_SHEEN_ALBEDO; ++i) {
      const optics::GgxAlbedo& of = optics::ggx_albedo_table()[i];
      packed.albedos[i] = shader::vec4(of.once, of.edge, of.mean_once, of.mean_edge);
    }
  }
  if (has(shader::LOBE_sheen)) {
    packed.albedos.resize(FIRST_GLASS_ALBEDO);
    for (size_t i = 0; i < SHEEN_ALBEDOS * SHEEN_ALBEDOS; ++i) {
      const optics::SheenAlbedo& of = optics::sheen_albedo_table()[i];
      packed.albedos[FIRST_SHEEN_ALBEDO + i] = shader::vec4(of.unweakened, of.albedo, of.mean, 0);
    }
  }
  if (has(shader::LOBE_rough_glass)) {
    packed.albedos.resize(END_OF_ALBEDOS);
    std::set<int> slices;
    for (const shader::Medium& from : packed.media)
      for (const shader::Medium& to : packed.media)
        for (const double rounded : {1 - 1e-5, 1 + 1e-5})
          if (from.ior != to.ior)
            slices.insert(optics::glass_slice(double(from.ior), double(to.ior) * rounded));
    const std::vector<int> wanted(slices.begin(), slices.end());
    constexpr size_t entries = GLASS_ALBEDOS * GLASS_ALBEDOS;
    parallel_for(0, int(wanted.size()), [&](int k) {
      const int slice = wanted[size_t(k)];
      const auto begin = optics::glass_albedo_table(slice), end = optics::glass_albedo_table(slice + 1);
      for (size_t i = 0; i < entries; ++i)
        packed.albedos[FIRST_GLASS_ALBEDO + size_t(slice) * entries + i] =
            shader::vec4(begin[i], end[i], 0, 0);
    });
  }
}

}  // namespace eyeray::pack
