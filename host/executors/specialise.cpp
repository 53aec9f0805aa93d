#include "host/executors/specialise.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

#include "host/core/error.hpp"
#include "host/expression/emit.hpp"
#include "host/formula/formula.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/texture.hpp"

namespace eyeray::executors {
namespace {

// Above this many records of a kind the code outgrows what it saves, and its compilation what a frame saves.
constexpr size_t most_records = 24;
constexpr size_t most_vertices = 96;
// Of the 65 535 iterations that a capped driver grants an invocation, what we count on (docs/lavapipe.md).
constexpr uint64_t granted_iterations = 60000;

struct Row {
  std::string_view name;
  uint32_t number;
  std::string_view traits = "";  // as its row has them
};
#define ROW(name, number, ...) {#name, number, #__VA_ARGS__},
constexpr Row shapes[] = {SHAPES(ROW)};
constexpr Row immediate_leaves[] = {IMMEDIATE_LEAVES(ROW)};
constexpr Row deferred_leaves[] = {DEFERRED_LEAVES(ROW)};
constexpr Row deferred_shapes[] = {DEFERRED_SHAPES(ROW)};
constexpr Row textures[] = {TEXTURES(ROW)};
constexpr Row materials[] = {MATERIALS(ROW)};
constexpr Row cameras[] = {CAMERAS(ROW)};
constexpr Row lights[] = {LIGHTS(ROW)};
constexpr Row integrators[] = {INTEGRATORS(ROW)};
constexpr Row samplers[] = {SAMPLERS(ROW)};
#undef ROW

// The registry macro `list` with the rows that are used alone, and the files of `folder` that they need.
template <size_t n>
std::string registry(std::string_view list, std::string_view folder, const Row (&rows)[n],
                     const std::set<uint32_t>& used) {
  std::string includes;
  std::string entries;
  for (const Row& row : rows) {
    if (!used.contains(row.number)) continue;
    includes += fmt::format("#include \"{}/{}.glsl\"\n", folder, row.name);
    entries +=
        fmt::format(" X({}, {}u{}{})", row.name, row.number, row.traits.empty() ? "" : ", ", row.traits);
  }
  return fmt::format("#define {}(X){}\n{}", list, entries, includes);
}

std::string literal(float x) {
  return fmt::format("{:.9e}", x);
}
std::string literal(uint32_t x) {
  return fmt::format("{}u", x);
}
std::string literal(const shader::vec4& v) {
  return fmt::format("vec4({}, {}, {}, {})", literal(v.x), literal(v.y), literal(v.z), literal(v.w));
}
std::string literal(const shader::vec3& v) {
  return fmt::format("vec3({}, {}, {})", literal(v.x), literal(v.y), literal(v.z));
}
std::string literal(const shader::uvec4& v) {
  return fmt::format("uvec4({}, {}, {}, {})", literal(v.x), literal(v.y), literal(v.z), literal(v.w));
}
// A record of these members, in their order.
template <typename... Members>
std::string record_literal(std::string_view type, const Members&... members) {
  return fmt::format("{}({})", type, fmt::join(std::array{literal(members)...}, ", "));
}
std::string literal(const shader::Primitive& p) {
  return record_literal("Primitive", p.id, p.material_and_kind, p.optical_depth, p.extra, p.a, p.b, p.c);
}
std::string literal(const shader::Material& m) {
  return record_literal("Material", m.kind, m.flags, m.medium, m.optical_depth, m.base, m.specular,
                        m.reflected, m.ambient, m.emission, m.alpha, m.alpha_cutoff, m.shininess, m.a);
}
std::string literal(const shader::Texture& t) {
  return record_literal("Texture", t.color, t.kind, t.a, t.b, t.c);
}
std::string literal(const shader::Medium& m) {
  return record_literal("Medium", m.absorption, m.ior);
}
std::string literal(const shader::Light& l) {
  return record_literal("Light", l.intensity, l.kind, l.a, l.b);
}
std::string literal(const shader::Frame& f) {
  return record_literal("Frame", f.width, f.height, f.seed, f.samples_per_side, f.camera, f.pattern, f.media,
                        f.max_depth, f.light_count, f.loop_probe, f.integrator, f.triangle_method, f.right,
                        f.min_throughput, f.up, f.pixel_width, f.forward, f.pixel_height, f.background,
                        f.unused_0, f.ambient, f.unused_1);
}

// A loader that chooses among constants. A driver that runs both sides of every branch selects between
// registers faster than it gathers from memory; where all records agree, nothing is left to select.
template <typename Records>
std::string constant_loader(std::string_view type, std::string_view name, const Records& records) {
  std::string text = fmt::format("{0} load_{1}(uint i) {{\n  {0} r = {2};\n", type, name,
                                 literal(records.empty() ? typename Records::value_type{} : records[0]));
  for (size_t i = 1; i < records.size(); ++i)
    text += fmt::format("  if (i == {}u) r = {};\n", i, literal(records[i]));
  return text + "  return r;\n}\n";
}

bool few_shading_records(const records::PackedScene& scene) {
  return std::max({scene.materials.size(), scene.textures.size(), scene.media.size(), scene.lights.size()}) <=
         most_records;
}

bool few_primitives(const records::PackedScene& scene) {
  return !scene.has_bvh && scene.instances.empty() && scene.leaf_uses.empty() &&
         scene.primitives.size() <= most_records && scene.vertices.size() <= most_vertices;
}

// Everything but geometry and texels as constants, and the list of materials that materials/material.glsl
// unrolls. Not of images: each of them is far more code than what chooses between them.
std::string shading_as_constants(const records::PackedScene& scene,
                                 const std::set<uint32_t>& materials_used) {
  std::string text = constant_loader("Material", "material", scene.materials) +
                     constant_loader("Texture", "texture", scene.textures) +
                     constant_loader("Medium", "medium", scene.media) +
                     constant_loader("Light", "light", scene.lights) + "#define SHADING_AS_CONSTANTS\n";
  if (scene.texel_count > 0) return text;
  text += "#define SCENE_MATERIALS(X)";
  for (const uint32_t i : materials_used) {
    const auto row = std::ranges::find(materials, scene.materials[i].kind, &Row::number);
    text += fmt::format(" X({0}, {1}u, load_material({1}u))", row->name, i);
  }
  return text + "\n";
}

// What is the same for all pixels, as a constant.
std::string frame_as_constant(const shader::Frame& f) {
  return fmt::format("Frame load_frame() {{ return {}; }}\n#define FRAME_AS_CONSTANT\n", literal(f));
}

// Geometry as constants, and the list of primitives that bvh/traverse.glsl unrolls, in the order of their
// ids.
std::string primitives_as_constants(const records::PackedScene& scene) {
  std::string text = constant_loader("uvec4", "vertex", scene.vertices) +
                     constant_loader("Primitive", "primitive", scene.primitives) +
                     "#define SCENE_PRIMITIVES(X)";
  std::multimap<uint32_t, size_t> by_id;  // slots
  for (size_t i = 0; i < scene.primitives.size(); ++i) by_id.emplace(scene.primitives[i].id, i);
  for (const auto& [id, i] : by_id)
    text += fmt::format(" X({}, {}u, load_primitive({}u))", shapes[kind_of(scene.primitives[i])].name, i, i);
  return text + "\n";
}

// What shapes/implicit.glsl marches along: each formula that the scene has, and its own march.
std::string formulas(const records::PackedScene& scene) {
  if (scene.formulas.empty()) return "#define FORMULAS(X)\n";
  std::string text = "#include \"shapes/implicit/search.glsl\"\n";
  const auto loops = [](const records::PackedFormula& f) { return !f.by_bounds && f.formula->loops(); };
  if (std::ranges::any_of(scene.formulas, loops))
    text +=
        "uint formula_turns = 0u;\nbool formula_overran = false;\n#define FORMULA_OVERRAN formula_overran\n"
        "bool formula_turn(uint turns) {\n  formula_turns = formula_turns + turns;\n"
        "  formula_overran = formula_overran || formula_turns > FORMULA_TURNS;\n  return "
        "!formula_overran;\n}\n";
  std::string rows;
  for (size_t i = 0; i < scene.formulas.size(); ++i) {
    const formula::Formula& formula = *scene.formulas[i].formula;
    const std::string name = fmt::format("f{}_", i);
    rows += fmt::format(" X({0}u, formula{0})", i);
    if (scene.formulas[i].by_bounds) {
      const expression::StraightLine& line = formula.straight_line();
      text += expression::bound_text(line, fmt::format("formula{}_bound", i)) +
              expression::gradient_text(line, fmt::format("formula{}_dual", i));
      text += fmt::format(
          "#define FORMULA_NAME(part) formula{0}_##part\n"
          "#define FORMULA_BOUND(it, x, y, z) formula{0}_bound(x, y, z)\n"
          "#define FORMULA_DUAL(it, p) formula{0}_dual(p)\n#include \"shapes/implicit/bounded_search.glsl\"\n"
          "#undef FORMULA_NAME\n#undef FORMULA_BOUND\n#undef FORMULA_DUAL\n",
          i);
      continue;
    }
    text += formula.kernel(name);
    const std::string restart = formula.loops() ? "formula_turns = 0u; " : "";
    text += fmt::format("float formula{}_value(vec3 p) {{ {}return {}f(p); }}\n", i, restart, name);
    text += fmt::format("vec3 formula{}_gradient(vec3 p) {{ {}return {}; }}\n", i, restart,
                        formula.has_gradient() ? name + "gradient(p)" : "vec3(0.0f, 0.0f, 0.0f)");
    text += fmt::format(
        "#define FORMULA_NAME(part) formula{0}_##part\n#define FORMULA_VALUE(it, p) formula{0}_value(p)\n"
        "#define FORMULA_HAS_GRADIENT(it) {1}\n#define FORMULA_GRADIENT(it, p) formula{0}_gradient(p)\n"
        "#include \"shapes/implicit/lipschitz_march.glsl\"\n"
        "#undef FORMULA_NAME\n#undef FORMULA_VALUE\n#undef FORMULA_HAS_GRADIENT\n#undef FORMULA_GRADIENT\n",
        i, formula.has_gradient());
  }
  return text + "#define FORMULAS(X)" + rows + "\n";
}

// The kinds that rays wait with in BVHs: none where all are slow, or nothing is in a BVH.
std::set<uint32_t> deferred_kinds(const records::PackedScene& scene) {
  std::set<uint32_t> slow;
  for (const Row& row : deferred_shapes)
    if (scene.has_bvh && scene.bvh_kinds.contains(row.number)) slow.insert(row.number);
  return slow == scene.bvh_kinds ? std::set<uint32_t>() : slow;
}

bool varies(const shader::Texture& texture) {
  return std::ranges::find(texture_rows, texture.kind, &TextureRow::number)->varies;
}

// Whether any texture of the material varies over a surface.
bool varies(const records::PackedScene& scene, const shader::Material& material) {
  return std::ranges::any_of(std::array{material.base, material.specular, material.reflected,
                                        material.ambient, material.emission, material.alpha},
                             [&](uint32_t texture) { return varies(scene.textures[texture]); });
}

bool is_black(const shader::Texture& texture) {
  return !varies(texture) && texture.color == shader::vec3(0);
}

bool any_emits(const records::PackedScene& scene) {
  return std::ranges::any_of(scene.materials, [&](const shader::Material& material) {
    return !is_black(scene.textures[material.emission]);
  });
}

// Whether any material may send rays on.
bool any_reflects(const records::PackedScene& scene) {
  return scene.media.size() > 1 ||
         std::ranges::any_of(scene.materials, [&](const shader::Material& material) {
           return !is_black(scene.textures[material.reflected]);
         });
}

}  // namespace

uint32_t most_bounces(const records::PackedScene& scene) {
  return traits_of(IntegratorType(scene.frame.integrator)).scatters && any_reflects(scene)
             ? scene.frame.max_depth
             : 0;
}

bool casts_shadow_rays(const records::PackedScene& scene) {
  return traits_of(IntegratorType(scene.frame.integrator)).shadow_rays && !scene.lights.empty();
}

uint64_t trace_iterations(const records::PackedScene& scene, bool unrolled) {
  return scene.has_bvh ? 0 : (unrolled ? 0 : scene.primitives.size()) + scene.shape_iterations;
}

uint32_t loop_budget_of(const records::PackedScene& scene, std::string_view driver) {
  // One ray with its shadow rays must fit whatever came before it. In a BVH it makes far fewer iterations
  // than there are primitives; where it does not, the shader sees that the driver stopped it.
  const uint64_t one_ray = (trace_iterations(scene, false) + 1) * (scene.lights.size() + 1);
  if (one_ray < granted_iterations) return uint32_t(granted_iterations - one_ray);
  throw Error(ExitCode::no_device,
              "{} ends loops after 65 535 iterations and says nothing, too few for {} primitives{} and "
              "{} lights without a BVH: use a newer driver, or --backend twin",
              driver, scene.primitives.size(),
              scene.shape_iterations > 0
                  ? fmt::format(" ({} iterations round their outlines)", scene.shape_iterations)
                  : "",
              scene.lights.size());
}

// Each define that is written here has its meaning in shaders/kernels/features.h.
std::string specialise(const records::PackedScene& scene, const Specialisation& options) {
  std::set<uint32_t> shapes_used, leaves_used, materials_used, material_kinds, kinds_with_uv,
      alpha_tested_kinds;
  const auto take_note = [&](const auto& uses, std::set<uint32_t>& kinds) {
    for (const auto& [kind, material] : uses) {
      kinds.insert(kind);
      materials_used.insert(material);
      material_kinds.insert(scene.materials[material].kind);
      if (varies(scene, scene.materials[material])) kinds_with_uv.insert(kind);
      if (scene.materials[material].alpha_cutoff > 0) alpha_tested_kinds.insert(kind);
    }
  };
  take_note(scene.uses, shapes_used);
  take_note(scene.leaf_uses, leaves_used);
  const bool media = scene.media.size() > 1;
  const bool absorption = std::any_of(scene.media.begin(), scene.media.end(),
                                      [](const shader::Medium& m) { return m.absorption != glm::vec3(0); });
  const bool unrolled = options.constants && few_primitives(scene);

  std::string text = "// Made for this scene by executors/specialise.cpp.\n";
  const auto define = [&](std::string_view name, const auto& value) {
    text += fmt::format("#define {} {}\n", name, value);
  };
  define("LIGHT_COUNT", fmt::format("{}u", scene.lights.size()));
  define("TRIANGLE_METHOD", fmt::format("{}u", scene.frame.triangle_method));
  define("HAS_COLORS", int(scene.vertex_colors));
  define("HAS_EMISSION", int(any_emits(scene)));
  define("HAS_ALPHA_TEST", int(!alpha_tested_kinds.empty()));
  define("HAS_MEDIA", int(media));
  define("HAS_ABSORPTION", int(absorption));
  // Only where a ray splits in two does a child wait, and one a level at most.
  define("PATH_STACK", media ? scene.frame.max_depth : 0u);
  define("TRACE_ITERATIONS", fmt::format("{}u", trace_iterations(scene, unrolled)));
  define("TEXEL_BUFFERS", int(options.profile.texel_buffers));
  define("HAS_BVH", scene.has_bvh ? "true" : "false");
  define("QUANTISED_NODES", scene.quantised_nodes ? "true" : "false");
  define("HAS_SECONDARY", int(most_bounces(scene) > 0));
  // Of these only one is compiled.
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
  define("HAS_DEFERRED_LEAVES", int(std::ranges::any_of(deferred_leaves, [&](const Row& row) {
           return leaves_used.contains(row.number);
         })));
  define("HAS_MIXED_CSG", int(scene.mixed_csg));
  define("HAS_INSTANCES", int(!scene.instances.empty()));
  define("INSTANCE_COUNT", fmt::format("{}u", scene.instances.size()));
  // In a BVH of one kind of shape nothing need ask for the kind.
  define("BVH_HOLDS(number, primitive)", scene.bvh_kinds.size() == 1
                                             ? fmt::format("(number == {}u)", *scene.bvh_kinds.begin())
                                             : "(kind_of(primitive) == number)");
  define("BVH_OF_TRIANGLES", int(scene.bvh_kinds == std::set<uint32_t>{shader::KIND_triangle}));
  if (options.loop_budget > 0) define("LOOP_BUDGET", fmt::format("{}u", options.loop_budget));
  define("GROUP_STRIDE", fmt::format("{}u", options.group_stride));
  for (const Row& shape : shapes) {
    define(fmt::format("KIND_{}", shape.name), fmt::format("{}u", shape.number));
    define(fmt::format("FIRST_{}", shape.name), fmt::format("{}u", scene.first_linear(shape.number)));
    define(fmt::format("END_{}", shape.name), fmt::format("{}u", scene.linear_ends[shape.number]));
    define(fmt::format("UV_{}", shape.name), kinds_with_uv.contains(shape.number) ? "true" : "false");
  }
  text += "#define KIND_FIRST(name) FIRST_##name\n#define KIND_END(name) END_##name\n";
  // Whoever looks at hits looks at uv too.
  text +=
      "#if defined FIRST_HITS || defined PROBING\n#define UV_OF(name) true\n#else\n#define UV_OF(name) "
      "UV_##name\n#endif\n";
  text += fmt::format("#ifdef FIRST_HITS\n#define SEARCH_COST {}\n#else\n#define SEARCH_COST 0\n#endif\n",
                      int(options.search_cost));
  const std::set<uint32_t> slow = deferred_kinds(scene);
  define("HAS_DEFERRED_SHAPES", int(!slow.empty()));
  text += "#include \"kernels/features.h\"\n#include \"kernels/bindings.glsl\"\n";
  if (options.constants && few_shading_records(scene)) text += shading_as_constants(scene, materials_used);
  // Where the eye moves, so do primitives: such a kernel is made anew for each camera as it is.
  if (unrolled) text += primitives_as_constants(scene) + frame_as_constant(scene.frame);
  text += "#include \"kernels/loaders.glsl\"\n";
  text += formulas(scene);
  std::set<uint32_t> texture_kinds, light_kinds;
  for (const shader::Texture& texture : scene.textures) texture_kinds.insert(texture.kind);
  for (const shader::Light& light : scene.lights) light_kinds.insert(light.kind);
  text += registry("TEXTURES", "textures", textures, texture_kinds);
  text += registry("CLOSED_SHAPES", "shapes", shapes, leaves_used);
  text += registry("IMMEDIATE_LEAVES", "shapes", immediate_leaves, leaves_used);
  text += registry("DEFERRED_LEAVES", "shapes", deferred_leaves, leaves_used);
  text += registry("SHAPES", "shapes", shapes, shapes_used);
  std::set<uint32_t> quick;
  std::ranges::set_difference(scene.bvh_kinds, slow, std::inserter(quick, quick.end()));
  text += registry("IMMEDIATE_SHAPES", "shapes", shapes, quick);
  text += registry("DEFERRED_SHAPES", "shapes", shapes, slow);
  text += registry("ALPHA_TESTED_SHAPES", "shapes", shapes, alpha_tested_kinds);
  text += registry("MATERIALS", "materials", materials, material_kinds);
  text += registry("LIGHTS", "lights", lights, light_kinds);
  text += registry("CAMERAS", "cameras", cameras, {scene.frame.camera});
  text += registry("SAMPLERS", "samplers", samplers, {scene.frame.pattern});
  text += registry("INTEGRATORS", "integrators", integrators, {scene.frame.integrator});
  return text;
}

}  // namespace eyeray::executors
