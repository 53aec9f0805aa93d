#include "host/scene/interfaces.hpp"

#include <algorithm>
#include <map>

#include "host/scene/integrator.hpp"

namespace eyeray::engine {

bool any_interface(const Scene& scene) {
  if (!walks_at_random(scene.render.integrator)) return false;
  struct Media {
    int count = 0;
    bool any_scatters = false;
  };
  std::map<double, Media> by_index;
  // With dispersion, media of one index have different ones at other colours.
  if (std::ranges::any_of(scene.materials, [](const auto& material) {
        return material->medium() && material->medium()->dispersion > 0;
      }))
    return false;
  for (const auto& material : scene.materials) {
    if (!fills(*material, scene.render.integrator)) continue;
    const Medium medium = *material->medium();
    if (medium.ior == scene.medium.ior) return true;
    Media& same = by_index[medium.ior];
    same.any_scatters |= medium.scattering != Vec3(0);
    if (++same.count > 1 && same.any_scatters) return true;
  }
  return false;
}

}  // namespace eyeray::engine
