#include "host/reference/photon_source.hpp"

#include <algorithm>
#include <cmath>

#include "host/reference/emitter_sample.hpp"
#include "host/reference/environment.hpp"
#include "host/reference/medium_extent.hpp"
#include "host/reference/photon_aim.hpp"
#include "host/reference/sample_rays.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::engine::reference {
namespace {

Vec3 around_axis(const Vec3& axis, double cosine, double turn) {
  const auto [s, t] = tangents(axis);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return cosine * axis + sine * (std::cos(turn) * s + std::sin(turn) * t);
}

// The direction of a photon from a point or a surface, either aimed or `at_random`. heading: two random
// numbers.
Aimed aimed_from(const PhotonSettings& scene, const Vec3& p, const Vec3& n, double random,
                 const Vec2& heading, const Vec3& at_random) {
  return aimed(windows_from(scene, p, n), random, at_random, [&](const Window& window) {
    return around_axis(window.middle, 1 - heading.x * window.area / (2 * M_PI), 2 * M_PI * heading.y);
  });
}

// A photon of light of irradiance 1 from direction d. It starts on a disk perpendicular to d, as wide as the
// scene and in front of all of it.
PhotonSource from_afar(const PhotonSettings& scene, const Vec3& d, const Vec2& start, double random) {
  const auto [s, t] = tangents(d);
  const Vec2 at = on_disk(start);
  const Vec3 across = at.x * s + at.y * t;
  const Aimed aim = aimed(windows_along(scene, d), random, scene.reach * across, [&](const Window& window) {
    return window.middle + std::sqrt(window.area / M_PI) * across;
  });
  const double area = M_PI * scene.reach * scene.reach;
  const bool before_all = !aim.by_aim || glm::length(aim.at) < scene.reach;
  return {.ray = {scene.center + aim.at + scene.reach * d, -d},
          .flux = Vec3(before_all ? area * aim.weight(1 / area) : 0),
          .light = 0,
          .aim = aim.event};
}

// Light from infinitely far away has crossed the medium around all objects. If little of a photon's light is
// left, the photon is made rare instead of weak, by a random number.
void weaken_upstream(const Scene& scene, PhotonSource& source, double random) {
  if (scene.medium_extent.endless()) return;
  const Ray upstream{source.ray.o, -source.ray.d};
  const Vec3 left = transmittance(
      scene.medium, medium_length(scene.medium_extent, upstream, std::numeric_limits<double>::infinity()));
  const double survival = std::max({left.x, left.y, left.z});
  source.flux *= random < survival ? left / survival : Vec3(0);
}

// A light of classic intensity 1 sends π into each unit of solid angle, or on each unit of area.
struct FromLight {
  const PhotonSettings& scene;
  Vec2 start, heading;
  double random;  // the random number that decides whether and where it is aimed

  PhotonSource operator()(std::monostate) const { return {.ray = {}, .light = 0}; }
  PhotonSource operator()(const PointLight& light) const {
    const Aimed way = aimed_from(scene, light.position, Vec3(0), random, heading,
                                 around_axis({0, 1, 0}, 1 - 2 * heading.x, 2 * M_PI * heading.y));
    return {.ray = {light.position, way.at},
            .flux = 4 * M_PI * M_PI * way.weight(1 / (4 * M_PI)) * light.intensity,
            .light = 0,
            .aim = way.event};
  }
  PhotonSource operator()(const SpotLight& light) const {
    const double inner = std::cos(light.inner), outer = std::cos(light.outer);
    const double at_random = 1 - heading.x * (1 - outer);
    const Aimed way = aimed_from(scene, light.position, Vec3(0), random, heading,
                                 around_axis(light.direction, at_random, 2 * M_PI * heading.y));
    const double cosine = way.by_aim ? glm::dot(way.at, light.direction) : at_random;
    const double within = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
    const double area = 2 * M_PI * (1 - outer);
    return {.ray = {light.position, way.at},
            .flux = area * way.weight(1 / area) * M_PI * within * within * light.intensity,
            .light = 0,
            .aim = way.event};
  }
  PhotonSource operator()(const DirectionalLight& light) const {
    const double widest = std::cos(light.angle / 2);
    const Vec3 towards =
        light.angle == 0 ? light.to_light
                         : around_axis(light.to_light, 1 - heading.x * (1 - widest), 2 * M_PI * heading.y);
    PhotonSource source = from_afar(scene, towards, start, random);
    source.flux *= 2 * M_PI / (1 + widest) * light.intensity;
    return source;
  }
};

// A point for which sample_emitter() chooses points by area: inside a closed form, or on a flat one.
Vec3 middle_of(const EmitterForm& form) {
  if (const auto* sphere = std::get_if<SphereForm>(&form)) return sphere->center;
  if (const auto* box = std::get_if<BoxForm>(&form)) return Vec3(box->to_world[3]);
  if (const auto* ellipsoid = std::get_if<EllipsoidForm>(&form)) return Vec3(ellipsoid->to_world[3]);
  if (const auto* cylinder = std::get_if<CylinderForm>(&form)) return Vec3(cylinder->to_world[3]);
  return point_of(form);
}

// A direction whose density is proportional to its cosine with n.
Vec3 from_plane(const Vec3& n, const Vec2& u) {
  const auto [s, t] = tangents(n);
  const Vec2 at = on_disk(u);
  const double radius = std::max(std::abs(2 * u.x - 1), std::abs(2 * u.y - 1));
  return at.x * s + at.y * t + std::sqrt(1 - radius * radius) * n;
}

PhotonSource from_surface(const Scene& scene, const PhotonSettings& settings, const Emitter& emitter,
                          const Vec2& start, const Vec2& heading, const Vec2& side) {
  const Vec3 middle = middle_of(emitter.form);
  const EmitterSample point = sample_emitter(emitter.form, middle, start);
  const bool below = emitter.side == 0 ? side.x >= 0.5 : emitter.side < 0;
  const Vec3 n = below ? -point.normal : point.normal;
  const Aimed aim = aimed_from(settings, point.position, n, side.y, heading, from_plane(n, heading));
  const Vec3& d = aim.at;

  // The density of the point by area, computed from its density by solid angle. On flat forms, points are
  // uniform.
  const Vec3 way = point.position - middle;
  const double distance = glm::length(way);
  const double by_area = is_flat(emitter.form)
                             ? 1 / area_of(emitter.form)
                             : emitter_density(emitter.form, middle, point) *
                                   std::abs(glm::dot(way, point.normal)) / (distance * distance * distance);

  const double size = glm::length(point.position) + glm::length(way);
  const Vec3 radiance = emitter_radiance(scene, emitter, point, point.position + d);
  return {.ray = {point.position + 1e-12 * size * n, d},
          .flux = (emitter.side == 0 ? 2 : 1) * M_PI / by_area * aim.weight(glm::dot(n, d) / M_PI) * radiance,
          .light = 0,
          .below = below,
          .aim = aim.event};
}

}  // namespace

std::vector<std::vector<int>> media_of_lights(const Tracer& tracer) {
  const Scene& scene = tracer.scene();
  const LightChoice& choice = tracer.light_choice();
  std::vector<std::vector<int>> media(2 * choice.ends.size());
  if (std::ranges::none_of(scene.materials,
                           [&](const auto& material) { return fills(*material, scene.render.integrator); }))
    return media;
  for (size_t i = 0; i < choice.ends.size(); ++i) {
    std::vector<int>&before = media[2 * i], &behind = media[2 * i + 1];
    if (i >= scene.lights.size()) {
      const Emitter& emitter = choice.emitters[i - scene.lights.size()];
      const PhotonSource some = from_surface(scene, {}, emitter, Vec2(0.5), Vec2(0.5), Vec2(0));
      before = behind = media_at(tracer, some.ray.o);
      if (emitter.side == 0 && fills(*scene.materials[size_t(emitter.material)], scene.render.integrator))
        behind.push_back(emitter.material);
      continue;
    }
    const LightForm form = scene.lights[i]->form();
    if (const auto* point = std::get_if<PointLight>(&form)) before = media_at(tracer, point->position);
    if (const auto* spot = std::get_if<SpotLight>(&form)) before = media_at(tracer, spot->position);
  }
  return media;
}

PhotonSources::PhotonSources(const Tracer& tracer)
    : tracer_(tracer),
      settings_(photon_settings(tracer.scene())),
      around_(environment_numbers(tracer.scene().environment.get(), !tracer.light_choice().ends.empty()) *
              0x1p-24) {
  for (const std::vector<int>& materials : media_of_lights(tracer)) {
    MediaStack& stack = media_.emplace_back();
    for (const int material : materials) stack.push(material);
  }
}

PhotonSource PhotonSources::draw(const std::function<Vec2(uint32_t)>& pair) const {
  const Scene& scene = tracer_.scene();
  const LightChoice& choice = tracer_.light_choice();
  const Vec2 random = pair(source_pair), start = pair(start_pair), heading = pair(heading_pair),
             side = pair(side_pair);
  if (random.y < around_) {
    const auto [d, density] = sample_environment(*scene.environment, heading);
    PhotonSource source = from_afar(settings_, d, start, side.y);
    source.flux *= environment_radiance(*scene.environment, d) / (density * around_);
    weaken_upstream(scene, source, side.x);
    source.light = uint64_t(-1);
    return source;
  }
  if (choice.ends.empty()) return {.ray = {}, .light = uint64_t(-1)};

  const auto number = uint32_t(random.x * 0x1p24);
  const auto light = size_t(std::ranges::upper_bound(choice.ends, number) - choice.ends.begin());
  PhotonSource source =
      light < scene.lights.size()
          ? std::visit(FromLight{settings_, start, heading, side.y}, scene.lights[light]->form())
          : from_surface(scene, settings_, choice.emitters[light - scene.lights.size()], start, heading,
                         side);
  source.flux /= (1 - around_) * choice.share(light);
  if (light < scene.lights.size() && std::isinf(scene.lights[light]->illuminate(source.ray.o).distance))
    weaken_upstream(scene, source, side.x);
  source.light = light;
  source.media = media_[2 * light + (source.below ? 1 : 0)];
  return source;
}

}  // namespace eyeray::engine::reference
