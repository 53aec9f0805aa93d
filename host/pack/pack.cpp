#include "host/pack/pack.hpp"

#include <cmath>

#include "host/core/error.hpp"
#include "host/pack/albedo_records.hpp"
#include "host/pack/emitter_records.hpp"
#include "host/pack/environment_records.hpp"
#include "host/pack/geometry.hpp"
#include "host/reference/media.hpp"
#include "host/reference/photon_source.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/interfaces.hpp"

namespace eyeray::engine::pack {
namespace {

// The stack of media in the form of materials/media.glsl: a byte each, the innermost lowest.
uint32_t media_stack(const std::vector<int>& media, const records::PackedScene& packed,
                     std::string_view who) {
  if (media.size() > 4)
    throw Error(ExitCode::bad_input, "{} is inside {} media at once; at most 4 may nest", who, media.size());
  uint32_t stack = 0;
  for (const int material : media) stack = stack << 8 | packed.materials[size_t(material)].medium;
  return stack;
}

// The media around the eye.
uint32_t pack_media(const Scene& scene, const records::PackedScene& packed) {
  return media_stack(reference::media_at(scene, scene.camera.eye), packed, "the camera's eye");
}

void pack_medium_extent(const Scene& scene, shader::Frame& frame) {
  const MediumExtent& extent = scene.medium_extent;
  if (extent.endless() || !walks_at_random(scene.render.integrator)) return;
  const Vec3& eye = scene.camera.eye;
  const Vec3 far{double(T_MISS)};
  const Bounds box = extent.bounds();
  frame.has_medium_extent = 1;
  frame.medium_min = glm::vec3(glm::max(box.min - eye, -far));
  frame.medium_max = glm::vec3(glm::min(box.max - eye, far));
  frame.medium_decay = float(1 / extent.scale_height);
  frame.medium_base = float(extent.base - eye.y);
}

shader::Frame pack_frame(const Scene& scene, const records::PackedScene& packed) {
  const CameraFrame camera = camera_frame(scene.camera, scene.image.size());
  shader::Frame frame{};
  frame.width = uint32_t(scene.image.width);
  frame.height = uint32_t(scene.image.height);
  frame.seed = scene.render.seed;
  frame.samples_per_side = uint32_t(std::lround(std::sqrt(double(scene.image.samples))));
  frame.camera = scene.camera.projection->kind();
  frame.pattern = uint32_t(scene.image.pattern);
  frame.media = pack_media(scene, packed);
  frame.max_depth = uint32_t(scene.render.max_depth);
  frame.light_count = uint32_t(packed.lights.size());
  frame.emitter_count = uint32_t(packed.emitters.size());
  frame.loop_probe = 2;
  frame.integrator = uint32_t(scene.render.integrator);
  frame.triangle_method =
      scene.render.triangle_method == TriangleMethod::woop ? TRIANGLE_WOOP : TRIANGLE_MOLLER_TRUMBORE;
  frame.right = glm::vec3(camera.right);
  frame.min_throughput = float(scene.render.min_throughput);
  frame.up = glm::vec3(camera.up);
  frame.pixel_width = float(2.0 / scene.image.width);
  frame.forward = glm::vec3(camera.forward);
  frame.pixel_height = float(2.0 / scene.image.height);
  frame.background = glm::vec3(scene.render.background);
  frame.ambient = glm::vec3(scene.render.ambient);
  const Aperture aperture = scene.camera.projection->aperture();
  frame.aperture = float(aperture.radius);
  frame.sharpness = float(glm::length(camera.forward) / aperture.focus);
  frame.blade_rotation = float(aperture.blade_rotation);
  frame.blades = uint32_t(aperture.blades);
  if (const EnvironmentMap* environment = scene.environment.get()) {
    frame.environment_width = uint32_t(environment->width());
    frame.environment_height = uint32_t(environment->height());
    frame.environment_turn = float(environment->turn());
    if (walks_at_random(scene.render.integrator))
      frame.environment_numbers = environment_numbers(environment, !packed.emitters.empty());
  }
  frame.pixel_filter = uint32_t(scene.image.filter);
  frame.filter_width = float(scene.image.filter_width);
  pack_medium_extent(scene, frame);
  return frame;
}

void pack_bent_normals(const Material& material, records::Packer& packer) {
  const uint32_t normal_map = material.normal_map ? material.normal_map->texture->pack(packer) : NONE;
  const uint32_t bump = material.bump_map ? material.bump_map->texture->pack(packer) : NONE;
  const auto& of_coat = material.coat_normal_map;
  const uint32_t coat_normal = of_coat ? of_coat->texture->pack(packer) : NONE;
  shader::Material& record = packer.scene.materials.back();
  record.normal_map = normal_map;
  record.bump = bump;
  record.coat_normal = coat_normal;
  if (of_coat) record.coat_normal_scale = float(of_coat->scale);
  if (material.normal_map) record.normal_scale = float(material.normal_map->scale);
  if (const auto& map = material.bump_map) {
    record.bump_height = float(map->height);
    record.bump_width = float(map->width);
    if (map->texture->in_space()) record.flags |= MATERIAL_BUMP_IN_SPACE;
  }
  if (const auto& axis = material.rough_axis) {
    const uint32_t direction = axis->texture ? axis->texture->pack(packer) : NONE;
    shader::Material& anisotropic = packer.scene.materials.back();
    anisotropic.flags |= MATERIAL_ANISOTROPIC;
    anisotropic.anisotropy_direction = direction;
    anisotropic.anisotropy_turn = glm::vec2(Vec2(std::cos(axis->turn), std::sin(axis->turn)));
  }
  packer.scene.bent_normals |= material.normal_map || material.bump_map || of_coat || material.rough_axis;
}

records::Packer pack_records(const Scene& scene, const PackOptions& options) {
  records::Packer packer(scene.camera.eye);
  for (const auto& material : scene.materials) {
    material->pack(packer);
    shader::Material& record = packer.scene.materials.back();
    if (material->emits_in_front) record.flags |= MATERIAL_EMITS_IN_FRONT;
    if (material->front_only) record.flags |= MATERIAL_FRONT_ONLY;
    if (walks_at_random(scene.render.integrator)) {
      record.optical_depth = OPTICAL_DEPTH_OPAQUE;
      if (material->thin()) {
        record.medium = 0;
        record.flags |= MATERIAL_PANE;
        packer.scene.panes = true;
      }
    }
    if (material->mask) {
      record.alpha = material->mask->alpha->pack(packer);
      record.alpha_cutoff = float(material->mask->cutoff);
      if (material->mask->blends) record.flags |= MATERIAL_BLENDS;
    }
    pack_bent_normals(*material, packer);
  }
  packer.scene.transparent = scene.image.transparent;
  packer.scene.interfaces = any_interface(scene);
  packer.scene.panes |= packer.scene.interfaces;
  pack_geometry(scene, options, packer);
  for (const auto& light : scene.lights) light->pack(packer);
  uint32_t light_bvh_numbers = 0;
  if (walks_at_random(scene.render.integrator)) {
    packer.scene.media[0] = records::to_record(scene.medium);
    const LightChoice choice = light_choice(scene);
    pack_light_choice(choice, packer);
    light_bvh_numbers = choice.bvh_numbers();
    if (sends_photons(scene.render.integrator))
      for (const std::vector<int>& media : reference::media_of_lights(reference::Tracer(scene)))
        packer.scene.emitter_media.push_back(media_stack(media, packer.scene, "a light"));
    pack_albedos(packer.scene);
  } else {
    packer.scene.lobes.clear();
    for (shader::Medium& medium : packer.scene.media) {
      medium.scattering = shader::vec3(0);
      medium.spread = 0;
    }
  }
  packer.scene.frame = pack_frame(scene, packer.scene);
  packer.scene.frame.light_bvh_numbers = light_bvh_numbers;
  if (const auto formula = scene.camera.projection->function())
    packer.scene.frame.camera_formula = packer.add_formula(formula);
  return packer;
}

}  // namespace

records::PackedScene pack(const Scene& scene, const PackOptions& options) {
  records::Packer packer = pack_records(scene, options);
  packer.write_texels();
  if (scene.environment) packer.scene.environment = pack_environment(*scene.environment);
  return std::move(packer.scene);
}

records::PackedScene pack_without_texels(const Scene& scene) {
  return pack_records(scene, {}).scene;
}

}  // namespace eyeray::engine::pack
