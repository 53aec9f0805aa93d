#include "host/loader/path_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/loader/medium.hpp"
#include "host/scene/emitters.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::engine::loader {

void warn_of_paths(const Scene& scene, DiagnosticLog& log) {
  for (const auto& material : scene.materials) {
    const ScatteringContext context{.point = Vec2(0.5), .cos_view = 1, .ior_from = 1, .ior_to = 1};
    const Scattering scattering = material->scattering(context);
    const Bsdf bsdf = material->bsdf(context, scattering);
    const auto exceeds = [](const Vec3& share) { return glm::any(glm::greaterThan(share, Vec3(1 + 1e-9))); };
    if (exceeds(scattering.diffuse))
      log.warning(
          {}, fmt::format(
                  "material \"{}\" would scatter more light than it receives: its `diffuse` is clamped to 1",
                  material->name));
    else if (exceeds(bsdf.diffuse + bsdf.mirror + bsdf.transmitted))
      log.warning({}, fmt::format("material \"{}\" scatters more light than it receives: `diffuse` and "
                                  "`reflectance` add up to more than 1",
                                  material->name));
  }
  const Emitters found = emitters(scene);
  const std::vector<SourcePosition>& unsampled = found.unsampled;
  const auto has_size = [&](const auto& light) { return light->illuminate(scene.camera.eye).angle > 0; };
  const auto glass = std::ranges::find_if(scene.materials, [&](const auto& material) {
    return fills(*material, scene.render.integrator) && material->medium()->ior != scene.medium.ior;
  });
  const bool photons = sends_photons(scene.render.integrator);
  if (!photons && glass != scene.materials.end() && !std::ranges::all_of(scene.lights, has_size))
    log.warning({}, fmt::format("paths cannot find lights without a size through glass (material \"{}\"): "
                                "its shadow lacks their light and their caustics; use integrator = "
                                "\"sppm\", or lights with a size (`emission`, or the `angle` of a "
                                "directional light)",
                                (*glass)->name));
  if (!photons && scene.lights.empty() && found.sampled.empty() && unsampled.empty() &&
      scene.render.background == Vec3(0) && !scene.environment)
    log.warning({},
                "the scene has no light: there is no [[light]], no `emission`, no `background` and no "
                "[environment]; the picture will be black");
  warn_of_endless_medium(scene, log);
  if (!photons && !unsampled.empty())
    log.warning(
        unsampled.front(),
        fmt::format(
            "paths find the light of this{} only by chance, which is noisy: they sample points on spheres, "
            "ellipsoids, boxes, cylinders, disks, triangles, parallelograms and meshes without cutouts",
            unsampled.size() == 1 ? "" : fmt::format(" and {} more", unsampled.size() - 1)));
}

}  // namespace eyeray::engine::loader
