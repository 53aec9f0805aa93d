#include "host/executors/scene_buffers.hpp"

namespace eyeray::engine::executors {
namespace {

enum class Kind { storage, texels };
enum class Part { geometry, shading };

template <typename Record>
SceneBuffer buffer(uint32_t binding, const char* name, std::span<const Record> records, Kind kind,
                   Part part) {
  return {
      binding, name, std::as_bytes(records), sizeof(Record), kind == Kind::texels, part == Part::geometry};
}

}  // namespace

std::array<SceneBuffer, 16> scene_buffers(const records::PackedScene& scene) {
  using enum Kind;
  using enum Part;
  const auto some = [](const auto& records) { return std::span(records); };
  return {buffer(BINDING_PRIMITIVES, "primitives", some(scene.primitives), texels, geometry),
          buffer(BINDING_VERTICES, "vertices", some(scene.vertices), texels, geometry),
          buffer(BINDING_NODES, "nodes", some(scene.nodes), texels, geometry),
          buffer(BINDING_BVHS, "BVHs", some(scene.bvhs), storage, geometry),
          buffer(BINDING_INSTANCES, "instances", some(scene.instances), storage, geometry),
          buffer(BINDING_MATERIALS, "materials", some(scene.materials), storage, shading),
          buffer(BINDING_TEXTURES, "textures", some(scene.textures), storage, shading),
          buffer(BINDING_TEXELS, "texels", some(scene.texels), texels, shading),
          buffer(BINDING_MEDIA, "media", some(scene.media), storage, shading),
          buffer(BINDING_LIGHTS, "lights", some(scene.lights), storage, shading),
          buffer(BINDING_EMITTERS, "emitters", some(scene.emitters), storage, shading),
          buffer(BINDING_EMITTER_MEDIA, "emitters' media", some(scene.emitter_media), storage, shading),
          buffer(BINDING_LIGHT_NODES, "light BVH", some(scene.light_nodes), storage, shading),
          buffer(BINDING_ENVIRONMENT, "environment", some(scene.environment), texels, shading),
          buffer(BINDING_ALBEDOS, "albedos", some(scene.albedos), storage, shading),
          buffer(BINDING_FRAME, "frame", std::span(&scene.frame, 1), texels, shading)};
}

SceneBuffer formula_numbers_buffer(std::span<const uint32_t> words) {
  return buffer(BINDING_FORMULA_NUMBERS, "formula numbers", words, Kind::storage, Part::shading);
}

SceneBuffer bvh4_buffer(std::span<const shader::uvec4> nodes) {
  return buffer(BINDING_BVH4_NODES, "BVH4 nodes", nodes, Kind::texels, Part::geometry);
}

}  // namespace eyeray::engine::executors
