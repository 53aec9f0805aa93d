#include "host/twin/scene_view.hpp"

#include "host/core/termination.hpp"
#include "host/formula/formula.hpp"
#include "host/twin/straight_line.hpp"
#include "host/twin/twin.hpp"

namespace eyeray::engine::twin {
namespace {

using shader::vec2, shader::vec3, shader::vec4;

const records::PackedFormula& packed(const void* scene, uint32_t number) {
  return static_cast<const records::PackedScene*>(scene)->formulas[number];
}

const formula::Formula& formula_of(const void* scene, uint32_t number) {
  return *packed(scene, number).formula;
}

RayRecorder& recorder_of(void* recorder) {
  return *static_cast<RayRecorder*>(recorder);
}

}  // namespace

SceneView view_of(const records::PackedScene& scene) {
  const FormulaView formulas{
      .scene = &scene,
      .value = [](const void* all, uint32_t i,
                  const vec3& p) { return formula_of(all, i).value(std::array{p.x, p.y, p.z}); },
      .gradient =
          [](const void* all, uint32_t i, const vec3& p) {
            const std::array<float, 3> gradient = formula_of(all, i).gradient(std::array{p.x, p.y, p.z});
            return vec3(gradient[0], gradient[1], gradient[2]);
          },
      .bound = [](const void* all, uint32_t i, const vec3& x, const vec3& y,
                  const vec3& z) { return affine_bound(formula_of(all, i).straight_line(), x, y, z); },
      .dual = [](const void* all, uint32_t i,
                 const vec3& p) { return differentiate(formula_of(all, i).straight_line(), p); },
      .color =
          [](const void* all, uint32_t i, const vec2& uv) {
            const std::array<float, 3> color = formula_of(all, i).color(std::array{uv.x, uv.y});
            return vec3(color[0], color[1], color[2]);
          },
      .direction =
          [](const void* all, uint32_t i, const vec4& at) {
            const std::array<float, 3> d = formula_of(all, i).direction(std::array{at.x, at.y, at.z, at.w});
            return vec3(d[0], d[1], d[2]);
          },
      .origin =
          [](const void* all, uint32_t i, const vec4& at) {
            const std::array<float, 3> o = formula_of(all, i).origin(std::array{at.x, at.y, at.z, at.w});
            return vec3(o[0], o[1], o[2]);
          },
      .has_gradient = [](const void* all, uint32_t i) { return formula_of(all, i).has_other(); },
      .by_bounds = [](const void* all, uint32_t i) { return packed(all, i).by_bounds; }};
  return {.frame = &scene.frame,
          .primitives = scene.primitives.data(),
          .linear_ends = scene.linear_ends.data(),
          .vertices = scene.vertices.data(),
          .nodes = scene.nodes.data(),
          .bvhs = scene.bvhs.data(),
          .instances = scene.instances.data(),
          .instance_count = uint32_t(scene.instances.size()),
          .materials = scene.materials.data(),
          .textures = scene.textures.data(),
          .texels = scene.texels.data(),
          .environment = scene.environment.data(),
          .media = scene.media.data(),
          .lights = scene.lights.data(),
          .emitters = scene.emitters.data(),
          .light_nodes = scene.light_nodes.data(),
          .emitter_media = scene.emitter_media.data(),
          .albedos = scene.albedos.data(),
          .albedo_count = uint32_t(scene.albedos.size()),
          .has_bvh = scene.has_bvh,
          .quantised_nodes = scene.quantised_nodes,
          .panes = scene.panes,
          .interfaces = scene.interfaces,
          .transparent = scene.transparent,
          .photon_pass = nullptr,
          .photons = nullptr,
          .photon_cells = nullptr,
          .formulas = formulas,
          .loops = {},
          .stop_if_interrupted = [] { stop_if_interrupted(); }};
}

Spectator spectator_for(RayRecorder& recorder) {
  using enum ProbedValue::Type;
  return {.recorder = &recorder,
          .value =
              [](void* to, const char* name, uint32_t line, uint32_t type, int size, const double* numbers) {
                ProbedValue value{.name = name,
                                  .type = type == PROBE_FLOAT  ? real
                                          : type == PROBE_BOOL ? boolean
                                                               : integer,
                                  .size = size,
                                  .line = line};
                std::copy_n(numbers, size, value.numbers.begin());
                recorder_of(to).value(std::move(value));
              },
          .ray = [](void* to, uint32_t kind, uint32_t number,
                    uint32_t depth) { recorder_of(to).ray(RayKind(kind), number, depth); },
          .back = [](void* to, uint32_t depth) { recorder_of(to).back(depth); }};
}

Spectator spectator_for(std::vector<uint32_t>& events) {
  return {.recorder = &events,
          .value =
              [](void* to, const char* name, uint32_t, uint32_t, int, const double* numbers) {
                if (std::string_view(name) == "event")
                  static_cast<std::vector<uint32_t>*>(to)->push_back(uint32_t(numbers[0]));
              },
          .ray = [](void*, uint32_t, uint32_t, uint32_t) {},
          .back = [](void*, uint32_t) {}};
}

}  // namespace eyeray::engine::twin
