#include "host/pack/pack.hpp"

#include <bit>
#include <cmath>

#include "host/core/error.hpp"
#include "host/pack/geometry.hpp"
#include "host/reference/media.hpp"
#include "host/scene/camera_frame.hpp"

namespace eyeray {
namespace {

shader::Light pack_light(const Light& light, const Packer& packer) {
  shader::Light record{};
  const bool point = light.type == LightType::point;
  record.head.x = point ? LIGHT_POINT : LIGHT_DIRECTIONAL;
  record.head.y = light.falloff == Falloff::inverse_square ? FALLOFF_INVERSE_SQUARE : FALLOFF_NONE;
  record.position = to_vec4(point ? packer.relative(light.position) : light.to_light);
  record.intensity = to_vec4(light.intensity);
  return record;
}

shader::uvec4 pack_mask(const AlphaMask& mask, Packer& packer) {
  return {packer.add_texture(mask.alpha), std::bit_cast<uint32_t>(float(mask.cutoff)), 0u, 0u};
}

// The media around the eye as materials/media.glsl stacks them: a byte each, the innermost lowest.
uint32_t pack_media(const Scene& scene, const PackedScene& packed) {
  const std::vector<int> media = reference::media_at(scene, scene.camera.eye);
  if (media.size() > 4)
    throw Error(ExitCode::bad_input, "the camera's eye is inside {} media at once; at most 4 may nest",
                media.size());
  uint32_t stack = 0;
  for (const int material : media) stack = stack << 8 | packed.materials[size_t(material)].head.z;
  return stack;
}

shader::Frame pack_frame(const Scene& scene, const PackedScene& packed) {
  const CameraFrame camera = camera_frame(scene.camera, scene.image.width, scene.image.height);
  shader::Frame frame{};
  frame.image = {uint32_t(scene.image.width), uint32_t(scene.image.height), scene.render.seed,
                 uint32_t(std::lround(std::sqrt(double(scene.image.samples))))};
  frame.camera = {scene.camera.type == CameraType::orthographic ? CAMERA_ORTHOGRAPHIC : CAMERA_PERSPECTIVE,
                  scene.image.pattern == SamplePattern::jittered ? PATTERN_JITTERED : PATTERN_REGULAR,
                  pack_media(scene, packed), uint32_t(scene.render.max_depth)};
  frame.counts = {
      uint32_t(packed.lights.size()), 2, uint32_t(scene.render.integrator),
      scene.render.triangle_method == TriangleMethod::woop ? TRIANGLE_WOOP : TRIANGLE_MOLLER_TRUMBORE};
  frame.right = to_vec4(camera.right, scene.render.min_throughput);
  frame.up = to_vec4(camera.up, 2.0 / scene.image.width);
  frame.forward = to_vec4(camera.forward, 2.0 / scene.image.height);
  frame.background = to_vec4(scene.render.background);
  frame.ambient = to_vec4(scene.render.ambient);
  return frame;
}

Packer pack_records(const Scene& scene, const PackOptions& options) {
  Packer packer(scene.camera.eye);
  for (const auto& material : scene.materials) {
    material->pack(packer);
    if (material->mask) packer.scene.materials.back().mask = pack_mask(*material->mask, packer);
  }
  pack_geometry(scene, options, packer);
  for (const Light& light : scene.lights) packer.scene.lights.push_back(pack_light(light, packer));
  packer.scene.frame = pack_frame(scene, packer.scene);
  return packer;
}

}  // namespace

PackedScene pack(const Scene& scene, const PackOptions& options) {
  Packer packer = pack_records(scene, options);
  packer.write_texels();
  return std::move(packer.scene);
}

PackedScene pack_without_texels(const Scene& scene) {
  return pack_records(scene, {}).scene;
}

}  // namespace eyeray
