#include "host/loader/photon_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/scene/emitters.hpp"
#include "host/scene/environment.hpp"
#include "host/scene/photons.hpp"

namespace eyeray::engine::loader {
namespace {

// Limit on the cells along an axis that float32 can distinguish (shaders/integrators/photon_cells.glsl).
constexpr double most_cells = 1 << 22;
// Limit on the photons that a sample gathers: a sample that gathers more takes seconds.
constexpr double most_gathered = 1 << 20;

bool has_end(const Shape& shape) {
  const Bounds bounds = shape.bounds();
  return std::isfinite(glm::length(bounds.max - bounds.min));
}

// For each material, true if a surface of the scene has it. A material without a surface stores no photon.
std::vector<bool> used_materials(const Scene& scene) {
  std::vector<bool> used(scene.materials.size());
  const auto add = [&](const std::vector<std::unique_ptr<Shape>>& shapes) {
    for (const auto& shape : shapes)
      for_each_leaf(*shape, [&](const Shape& leaf) { used[size_t(leaf.material)] = true; });
  };
  const auto add_instances = [&](const std::vector<Instance>& instances) {
    for (const Instance& instance : instances) used[size_t(instance.material)] = true;
  };
  add(scene.shapes);
  add_instances(scene.instances);
  for (const GroupInstance& instance : scene.group_instances) {
    add(scene.groups[size_t(instance.group)].shapes);
    add_instances(scene.groups[size_t(instance.group)].instances);
  }
  return used;
}

void check_surfaces(const Scene& scene, reading::TableReader& render) {
  const std::vector<bool> used = used_materials(scene);
  size_t tried = 0;
  for (size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    if (scatters_widely(*scene.materials[i])) return;
    ++tried;
  }
  render.error(
      "integrator",
      tried == 0
          ? fmt::format("`sppm` has no surface that could store its {} photons: the scene has no shapes",
                        scene.render.photons)
          : fmt::format("no surface stores any of the {} photons of `sppm`: none of {} materials has a wide "
                        "lobe, by a colour or a roughness of 0.32 or more; `path` needs no such surface",
                        scene.render.photons, tried));
}

void check_lights(const Scene& scene, reading::TableReader& render, std::span<const SourcePosition> lights,
                  DiagnosticLog& log) {
  const Emitters found = emitters(scene);
  if (scene.lights.empty() && found.sampled.empty() && found.unsampled.empty() && !scene.environment)
    render.error("integrator", fmt::format("`sppm` has no light to emit its {} photons from: there is no "
                                           "[[light]], no `emission`, no `background` and no [environment]",
                                           scene.render.photons));
  if (!found.unsampled.empty())
    log.error(
        found.unsampled.front(),
        fmt::format(
            "`sppm` cannot emit photons from this{}: it samples points on spheres, ellipsoids, boxes, "
            "cylinders, disks, triangles, parallelograms and meshes without cutouts",
            found.unsampled.size() == 1 ? "" : fmt::format(" and {} more", found.unsampled.size() - 1)));
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const LightForm form = scene.lights[i]->form();
    if (const auto* point = std::get_if<PointLight>(&form); point && point->falloff == Falloff::none)
      log.error(lights[i],
                "`sppm` cannot emit photons from a point light with falloff = \"none\": equally many would "
                "have to arrive at any distance");
    else if (std::holds_alternative<std::monostate>(form))
      log.error(lights[i], fmt::format("`sppm` does not support photons from a light of the type \"{}\"",
                                       scene.lights[i]->type));
  }
}

// Reports radii and numbers of photons with which no picture can be made.
void check_radius(const Scene& scene, const PhotonSettings& settings, reading::TableReader& render) {
  const char* const key = render.has("photon_radius") ? "photon_radius" : "integrator";
  const double reach = settings.reach + glm::length(settings.center - scene.camera.eye);
  const double share = settings.radius / settings.reach;
  const double gathered = settings.count * std::min(1.0, share * share);
  if (settings.reach > 0 && share > 1)
    render.error(key,
                 fmt::format("photons would be gathered within {:.3g}, which is more than the scene's own "
                             "radius of {:.3g}: give a smaller `photon_radius`",
                             settings.radius, settings.reach));
  else if (settings.reach > 0 && gathered > most_gathered)
    render.error(
        key,
        fmt::format(
            "each sample would gather some {:.2g} of {} photons, within {:.3g} of a scene with a radius of "
            "{:.3g}, but at most {:.2g} are allowed: give a smaller `photon_radius`, or fewer `photons`",
            gathered, settings.count, settings.radius, settings.reach, most_gathered));
  else if (!(reach <= most_cells * 2 * settings.radius))
    render.error(
        key, fmt::format("photons would be gathered within {:.3g}, which float32 cannot resolve in a scene "
                         "that reaches {:.3g} from the eye: give a `photon_radius` of {:.2g} or more",
                         settings.radius, reach, reach / most_cells));
}

}  // namespace

void prepare_for_photons(Scene& scene, reading::TableReader& render, std::span<const SourcePosition> lights,
                         DiagnosticLog& log) {
  if (!scene.environment && scene.render.background != Vec3(0)) {
    image::Image even(1, 1, 3);
    for (int c = 0; c < 3; ++c) even.samples()[size_t(c)] = float(scene.render.background[c]);
    scene.environment = std::make_shared<EnvironmentMap>(std::move(even), 0);
  }
  check_lights(scene, render, lights, log);
  check_surfaces(scene, render);
  const PhotonSettings settings = photon_settings(scene);
  check_radius(scene, settings, render);

  const bool from_afar = scene.environment || std::ranges::any_of(scene.lights, [&](const auto& light) {
                           return std::isinf(light->illuminate(scene.camera.eye).distance);
                         });
  const auto endless = std::ranges::find_if(scene.shapes, [](const auto& shape) { return !has_end(*shape); });
  if (from_afar && endless != scene.shapes.end())
    log.warning((*endless)->position,
                fmt::format("light from infinitely far away emits photons only within {:.3g} of the centre "
                            "of the bounded shapes: this shape is unbounded, and the light that it scatters "
                            "onto other surfaces from farther away is missing",
                            settings.reach));
}

}  // namespace eyeray::engine::loader
