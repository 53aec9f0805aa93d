#include "host/executors/specialise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>

#include "host/executors/formula_functions.hpp"
#include "host/executors/loop_budget.hpp"
#include "host/executors/registry_text.hpp"
#include "host/executors/scene_constants.hpp"
#include "host/executors/scene_facts.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::engine::executors {
namespace {

// The kinds that a scene uses: its kernels have no others. `materials`: the indices of the materials in use.
struct Used {
  std::set<uint32_t> shapes, leaves, with_uv, alpha_tested, deferred, materials, material_kinds;
};

// The kinds whose intersection is deferred. There are none if BVHs hold only such kinds, or nothing.
std::set<uint32_t> deferred_kinds(const records::PackedScene& scene) {
  std::set<uint32_t> kinds;
  for (const Row& row : rows::deferred_shapes)
    if (scene.has_bvh && scene.bvh_kinds.contains(row.number)) kinds.insert(row.number);
  return kinds == scene.bvh_kinds ? std::set<uint32_t>() : kinds;
}

Used used_by(const records::PackedScene& scene) {
  Used used;
  const auto take_note = [&](const auto& uses, std::set<uint32_t>& kinds) {
    for (const auto& [kind, material] : uses) {
      kinds.insert(kind);
      used.materials.insert(material);
      used.material_kinds.insert(scene.materials[material].kind);
      if (varies(scene, scene.materials[material])) used.with_uv.insert(kind);
      if (scene.materials[material].alpha_cutoff > 0) used.alpha_tested.insert(kind);
    }
  };
  take_note(scene.uses, used.shapes);
  take_note(scene.leaf_uses, used.leaves);
  used.deferred = deferred_kinds(scene);
  return used;
}

// The macros of a scene's features; shaders/kernels/features.h explains each.
std::string defines(const records::PackedScene& scene, const Used& used, const Specialisation& options,
                    bool unrolled) {
  std::string text;
  const auto define = [&](std::string_view name, const auto& value) {
    text += fmt::format("#define {} {}\n", name, value);
  };
  define("LIGHT_COUNT", fmt::format("{}u", scene.lights.size()));
  define("EMITTER_COUNT", fmt::format("{}u", scene.emitters.size()));
  define("HAS_ENVIRONMENT", int(scene.frame.environment_width > 0));
  define("HAS_LIGHT_DISKS", int(any_light_disk(scene)));
  define("HAS_LIGHT_BVH", int(!scene.light_nodes.empty()));
  define("HAS_ENVIRONMENT_LIGHT", scene.frame.environment_numbers > 0 ? "true" : "false");
  define("IS_TRANSPARENT", scene.transparent ? "true" : "false");
  define("TRIANGLE_METHOD", fmt::format("{}u", scene.frame.triangle_method));
  define("HAS_COLORS", int(scene.own_colors));
  define("HAS_PIECES", int(scene.pieces));
  define("HAS_ROUND_CONES", int(scene.round_cones));
  define("HAS_LATHES", int(scene.lathes));
  define("HAS_SECOND_UV", int(scene.second_uv));
  define("HAS_SMOOTH", int(any_smooth(scene)));
  define("HAS_EMISSION", int(any_emits(scene)));
  define("HAS_EMISSION_TEXTURES", int(any_emission_texture(scene)));
  define("HAS_ONE_SIDED_EMISSION", int(any_emits_in_front(scene)));
  define("HAS_PHOTONS", int(sends_photons(IntegratorType(scene.frame.integrator))));
  define("HAS_GLOSSY", int(scene.lobes.contains(shader::LOBE_glossy)));
  define("HAS_CONDUCTORS", int(scene.has_conductors));
  define("HAS_ROUGH_DIFFUSE", int(any_rough_diffuse(scene)));
  define("HAS_SPECULAR_TEXTURES", int(any_specular_varies(scene)));
  define("HAS_COAT", int(scene.lobes.contains(shader::LOBE_coat)));
  define("HAS_BENT_COAT", int(any_bent_coat(scene)));
  define("HAS_ROUGH_GLASS", int(scene.lobes.contains(shader::LOBE_rough_glass)));
  define("HAS_BENT_NORMALS", int(scene.bent_normals));
  define("HAS_ALPHA_TEST", int(!used.alpha_tested.empty()));
  define("HAS_BLEND", int(!used.alpha_tested.empty() && any_blends(scene)));
  define("HAS_FRONT_ONLY", int(any_front_only(scene)));
  define("HAS_SHEEN", int(scene.lobes.contains(shader::LOBE_sheen)));
  define("HAS_THIN", int(scene.lobes.contains(shader::LOBE_thin)));
  define("HAS_TRANSLUCENT", int(scene.lobes.contains(shader::LOBE_translucent)));
  define("HAS_ANISOTROPY", int(any_anisotropic(scene)));
  define("HAS_FILM", int(scene.has_films));
  define("HAS_TRANSMISSION", int(any_principled_transmits(scene)));
  define("HAS_PANES", int(scene.panes));
  define("ANY_PANE", scene.panes ? "true" : "false");
  define("ANY_INTERFACE", scene.interfaces ? "true" : "false");
  define("HAS_MEDIA", int(transmits(scene)));
  define("HAS_DISPERSION", int(any_disperses(scene)));
  define("HAS_ABSORPTION", int(any_dims(scene)));
  define("HAS_SCATTERING", int(any_scatters(scene)));
  define("HAS_MEDIUM_EXTENT", int(scene.frame.has_medium_extent));
  // A child ray waits only if rays split in two, and at most one waits at each level.
  define("PATH_STACK", splits(scene) ? scene.frame.max_depth : 0u);
  define("RANDOM_WALK", int(walks_at_random(scene)));
  define("TRACE_ITERATIONS", fmt::format("{}u", trace_iterations(scene, unrolled)));
  define("TEXEL_BUFFERS", int(options.profile.texel_buffers));
  define("HAS_BVH", scene.has_bvh ? "true" : "false");
  define("QUANTISED_NODES", scene.quantised_nodes ? "true" : "false");
  define("HAS_LENS", int(scene.frame.aperture > 0));
  define("HAS_FILTER", int(scene.frame.pixel_filter != FILTER_BOX));
  define("HAS_SECONDARY", int(most_bounces(scene) > 0));
  // Only one camera, sampler and integrator is compiled.
  define("CAMERA_IS(number)", "true");
  define("SAMPLER_IS(number)", "true");
  define("INTEGRATOR_IS(number)", "true");
  define("RAY_KINDS", int(options.ray_kinds));
  define("SUBGROUP_SIZE", options.subgroup_size);
  define("PACKET_ROOT", fmt::format("{}u", options.packet_bvh.first_node));
  define("PACKET_STACK", options.packet_bvh.stack_size);
  define("MAY_REACH_ITERATION_LIMIT", int(scene.may_reach_iteration_limit));
  define("SHIFT_STACK", int(options.profile.shift_stack));
  define("STACK_SIZE", scene.stack_size);
  define("HAS_CSG", int(!scene.leaf_uses.empty()));
  define("HAS_DEFERRED_LEAVES", int(std::ranges::any_of(rows::deferred_leaves, [&](const Row& row) {
           return used.leaves.contains(row.number);
         })));
  define("HAS_MIXED_CSG", int(scene.mixed_csg));
  define("HAS_INSTANCES", int(!scene.instances.empty()));
  define("INSTANCE_COUNT", fmt::format("{}u", scene.instances.size()));
  // In a BVH of one kind of shape, no test of the kind is needed.
  define("BVH_HOLDS(number, primitive)", scene.bvh_kinds.size() == 1
                                             ? fmt::format("(number == {}u)", *scene.bvh_kinds.begin())
                                             : "(kind_of(primitive) == number)");
  define("BVH_OF_TRIANGLES", int(scene.bvh_kinds == std::set<uint32_t>{shader::KIND_triangle}));
  if (options.loop_budget > 0) define("LOOP_BUDGET", fmt::format("{}u", options.loop_budget));
  define("GROUP_STRIDE", fmt::format("{}u", options.group_stride));
  for (const Row& shape : rows::shapes) {
    define(fmt::format("KIND_{}", shape.name), fmt::format("{}u", shape.number));
    define(fmt::format("FIRST_{}", shape.name), fmt::format("{}u", scene.first_linear(shape.number)));
    define(fmt::format("END_{}", shape.name), fmt::format("{}u", scene.linear_ends[shape.number]));
    define(fmt::format("UV_{}", shape.name), used.with_uv.contains(shape.number) ? "true" : "false");
  }
  text += "#define KIND_FIRST(name) FIRST_##name\n#define KIND_END(name) END_##name\n";
  // Kernels that report hits report uv too.
  text +=
      "#if defined FIRST_HITS || defined PROBING\n#define UV_OF(name) true\n#else\n#define UV_OF(name) "
      "UV_##name\n#endif\n";
  text += fmt::format("#ifdef FIRST_HITS\n#define SEARCH_COST {}\n#else\n#define SEARCH_COST 0\n#endif\n",
                      int(options.search_cost));
  define("HAS_DEFERRED_SHAPES", int(!used.deferred.empty()));
  return text;
}

// The kinds of each texture of the materials. Most textures of a material are constants, even if others are
// not; the code that samples them is then short.
std::string textures_of_materials(const records::PackedScene& scene, const std::set<uint32_t>& materials) {
  std::string text = "#define TEXTURES_OF(name, X) TEXTURES_OF_##name(X)\n";
  for (const auto& [name, texture] : rows::material_textures) {
    std::set<uint32_t> kinds;
    for (const uint32_t i : materials) {
      const uint32_t index = scene.materials[i].*texture;
      if (index != NONE) kinds.insert(scene.textures[index].kind);
    }
    text += list_text(fmt::format("TEXTURES_OF_{}", name), rows::textures, kinds);
  }
  return text;
}

// The shaders' registries, with the used entries alone.
std::string registries(const records::PackedScene& scene, const Used& used) {
  std::set<uint32_t> texture_kinds, light_kinds, emitter_kinds;
  for (const shader::Texture& texture : scene.textures) texture_kinds.insert(texture.kind);
  for (const shader::Light& light : scene.lights) light_kinds.insert(light.kind);
  for (size_t i = scene.lights.size(); i < scene.emitters.size(); ++i)
    emitter_kinds.insert(scene.emitters[i].kind);
  std::string text = registry_text("TEXTURES", "textures", rows::textures, texture_kinds);
  text += textures_of_materials(scene, used.materials);
  text += registry_text("CLOSED_SHAPES", "shapes", rows::shapes, used.leaves);
  text += registry_text("IMMEDIATE_LEAVES", "shapes", rows::immediate_leaves, used.leaves);
  text += registry_text("DEFERRED_LEAVES", "shapes", rows::deferred_leaves, used.leaves);
  text += registry_text("SHAPES", "shapes", rows::shapes, used.shapes);
  std::set<uint32_t> immediate;
  std::ranges::set_difference(scene.bvh_kinds, used.deferred, std::inserter(immediate, immediate.end()));
  text += registry_text("IMMEDIATE_SHAPES", "shapes", rows::shapes, immediate);
  text += registry_text("DEFERRED_SHAPES", "shapes", rows::shapes, used.deferred);
  text += registry_text("ALPHA_TESTED_SHAPES", "shapes", rows::shapes, used.alpha_tested);
  text += registry_text("LOBES", "bsdf", rows::lobes, scene.lobes);
  text += list_text("PANES", rows::panes, used.material_kinds);
  text += registry_text("MATERIALS", "materials", rows::materials, used.material_kinds);
  text += registry_text("LIGHTS", "lights", rows::lights, light_kinds);
  text += registry_text("EMITTERS", "emitters", rows::emitters, emitter_kinds);
  text += registry_text("CAMERAS", "cameras", rows::cameras, {scene.frame.camera});
  text += registry_text("SAMPLERS", "samplers", rows::samplers, {scene.frame.pattern});
  text += registry_text("INTEGRATORS", "integrators", rows::integrators, {scene.frame.integrator});
  return text;
}

}  // namespace

std::string specialise(const records::PackedScene& scene, const Specialisation& options) {
  const Used used = used_by(scene);
  const bool unrolled = options.constants && options.profile.unrolls && few_primitives(scene);
  std::string text = "// Made for this scene by executors/specialise.cpp.\n" +
                     defines(scene, used, options, unrolled) +
                     (options.formula_numbers ? "#define FORMULA_NUMBERS\n" : "") +
                     "#include \"kernels/features.h\"\n#include \"kernels/bindings.glsl\"\n";
  if (options.constants && few_shading_records(scene)) text += shading_as_constants(scene, used.materials);
  // If the eye moves, the primitives move too, relative to it. A kernel that contains them is made anew for
  // each camera anyway.
  if (unrolled) text += primitives_as_constants(scene) + frame_as_constant(scene.frame);
  return text + "#include \"kernels/loaders.glsl\"\n" + formula_functions(scene, options.formula_numbers) +
         registries(scene, used);
}

}  // namespace eyeray::engine::executors
