// eyeray check: reads a scene, reports whether it is sound, and prints facts derived from it.
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "host/cameras/registry.hpp"
#include "host/cli/command.hpp"
#include "host/core/github_text.hpp"
#include "host/core/standard_streams.hpp"
#include "host/lights/registry.hpp"
#include "host/loader/scene_file.hpp"
#include "host/materials/registry.hpp"
#include "host/pack/environment_records.hpp"
#include "host/pack/pack.hpp"
#include "host/program/json.hpp"
#include "host/scene/extent.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/objects.hpp"
#include "host/scene/sampler.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::cli {
namespace {

struct CheckCommand {
  SceneOptions scene;
  bool schema = false;
  bool manual = false;
  bool json = false;

  ExitCode run() const;
};

// The kinds in registry order, each with its number; kinds that the scene lacks are left out.
using Counts = std::vector<std::pair<std::string, size_t>>;

struct Inventory {
  Counts shapes;
  Counts materials;
  Counts lights;
  size_t emitters = 0;             // surfaces that a path may choose
  size_t light_nodes = 0;          // nodes of the BVH by which it chooses
  size_t mesh_triangles = 0;       // each mesh counts once, however often it is shown
  size_t bytes = 0;                // on the device, pixels not counted
  size_t named = 0;                // shapes and meshes that have their own name
  std::vector<std::string> names;  // the names of the first few of these: `sphere "left eye"`
};

template <typename Types>
Counts count_kinds(const Types& all, const std::vector<uint32_t>& kinds) {
  std::vector<size_t> count(all.size());
  for (const uint32_t kind : kinds) ++count.at(kind);
  Counts counts;
  for (size_t kind = 0; kind < all.size(); ++kind) {
    if (count[kind] > 0) counts.emplace_back(all[kind]->name, count[kind]);
  }
  return counts;
}

template <typename Records>
size_t bytes(const Records& records) {
  return std::span(records).size_bytes();
}

// Counts each shape as often as it is shown.
uint64_t shapes_in_groups(const Scene& scene) {
  uint64_t count = 0;
  for (const GroupInstance& instance : scene.group_instances)
    count += scene.groups[size_t(instance.group)].shapes.size();
  return count;
}

uint64_t shapes_kept_in_groups(const Scene& scene) {
  uint64_t count = 0;
  for (const Group& group : scene.groups) count += group.shapes.size();
  return count;
}

void list_names(const Scene& scene, Inventory& inventory) {
  constexpr size_t most = 10;
  const Objects objects(scene);
  for (size_t i = 0; i < objects.size(); ++i) {
    const Object object = objects[i];
    if (!object.name.own || ++inventory.named > most) continue;
    inventory.names.push_back(describe(object, scene.names));
  }
}

Inventory take_inventory(const Scene& scene) {
  const records::PackedScene packed = pack::pack_without_texels(scene);
  Inventory inventory;
  const size_t environment_texels = scene.environment ? pack::environment_texels(*scene.environment) : 0;
  std::vector<const shapes::ShapeType*> tables(shapes::types().begin(), shapes::types().end());
  tables.insert(tables.end(), shapes::made_types().begin(), shapes::made_types().end());
  std::vector<uint32_t> kinds;
  for (const auto& shape : scene.shapes)
    kinds.push_back(
        uint32_t(std::ranges::find(tables, shape->type, &shapes::ShapeType::name) - tables.begin()));
  inventory.shapes = count_kinds(std::span<const shapes::ShapeType* const>(tables), kinds);
  kinds.clear();
  for (const shader::Material& material : packed.materials) kinds.push_back(material.kind);
  inventory.materials = count_kinds(materials::types(), kinds);
  kinds.clear();
  for (const shader::Light& light : packed.lights) kinds.push_back(light.kind);
  inventory.lights = count_kinds(lights::types(), kinds);
  inventory.emitters = packed.emitters.empty() ? 0 : packed.emitters.size() - packed.lights.size();
  inventory.light_nodes = packed.light_nodes.size();
  list_names(scene, inventory);
  for (const Mesh& mesh : scene.meshes) inventory.mesh_triangles += mesh.triangles.size();
  inventory.bytes = bytes(packed.primitives) + bytes(packed.vertices) + bytes(packed.nodes) +
                    bytes(packed.bvhs) + bytes(packed.instances) + bytes(packed.materials) +
                    bytes(packed.textures) + packed.texel_count * sizeof(packed.texels[0]) +
                    bytes(packed.media) + bytes(packed.lights) + bytes(packed.emitters) +
                    bytes(packed.light_nodes) + environment_texels * sizeof(packed.environment[0]) +
                    sizeof(packed.frame);
  return inventory;
}

std::string format_vec(const Vec3& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x + 0.0, v.y + 0.0, v.z + 0.0);
}

size_t unbounded_shapes(const Scene& scene) {
  return size_t(std::ranges::count_if(scene.shapes, [](const auto& shape) {
    const Bounds box = shape->bounds();
    return !is_finite(box) && glm::all(glm::lessThanEqual(box.min, box.max));
  }));
}

std::string format_bounds(const Scene& scene) {
  const Bounds all = extent(scene);
  const size_t unbounded = unbounded_shapes(scene);
  std::string text =
      is_finite(all) ? fmt::format("{} to {}", format_vec(all.min), format_vec(all.max)) : "none";
  if (unbounded > 0)
    text += fmt::format("{} {} unbounded shape{}", is_finite(all) ? ", and" : ":", unbounded,
                        unbounded == 1 ? "" : "s");
  return text;
}

// The point in front of the eye through which the plane of focus passes, perpendicular to the view. Empty if
// everything is sharp, or if the camera's function sets the focus.
std::optional<Vec3> focus_point(const Scene& scene) {
  const Projection& projection = *scene.camera.projection;
  if (projection.function() || projection.aperture().radius == 0) return std::nullopt;
  const CameraAxes camera = camera_axes(scene.camera);
  return camera.eye + projection.aperture().focus * camera.w;
}

std::string format_focus(const Scene& scene) {
  const Projection& projection = *scene.camera.projection;
  if (const std::optional<Vec3> point = focus_point(scene))
    return fmt::format(
        "{}, {:.6g} in front of the eye: the plane of focus passes through this point, perpendicular to w",
        format_vec(*point), projection.aperture().focus);
  return projection.function() ? "set by the camera's function"
                               : "everything is sharp: the camera has no aperture";
}

std::string format_counts(const Counts& counts) {
  std::string text;
  for (const auto& [name, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  return text.empty() ? "none" : text;
}

std::string_view camera_name(const Scene& scene) {
  return cameras::types()[scene.camera.projection->kind()]->name;
}

void print_text(const Scene& scene, const Inventory& inventory) {
  const ImageSettings& image = scene.image;
  const CameraAxes camera = camera_axes(scene.camera);
  const auto line = [](std::string_view name, const std::string& text) {
    print_lines(stdout, "{:<12} {}\n", name, log_line(text));
  };

  line("image", fmt::format("{}×{} pixels, {} sample{} a pixel, {}", image.width, image.height, image.samples,
                            image.samples == 1 ? "" : "s", sample_patterns[uint32_t(image.pattern)]));
  line("camera", std::string(camera_name(scene)));
  line("  eye", format_vec(camera.eye));
  line("  u right", format_vec(camera.u));
  line("  v up", format_vec(camera.v));
  line("  w forward", format_vec(camera.w));
  for (const CameraFact& fact : scene.camera.projection->facts(image.size()))
    line(fmt::format("  {}", fact.label), fact.text);
  line("  focus", format_focus(scene));
  const IntegratorType integrator = scene.render.integrator;
  line("integrator",
       fmt::format(
           "{}{}{}", integrator_names[uint32_t(integrator)],
           traits_of(integrator).ways > 0 ? fmt::format(", max_depth {}", scene.render.max_depth) : "",
           traits_of(integrator).ways > 1 ? fmt::format(", min_throughput {:g}", scene.render.min_throughput)
                                          : ""));
  line("shapes", format_counts(inventory.shapes));
  line("bounds", format_bounds(scene));
  if (!scene.meshes.empty()) {
    line("meshes", fmt::format("{} of {} triangles, shown {} times", scene.meshes.size(),
                               inventory.mesh_triangles, scene.instances.size()));
  }
  if (!scene.groups.empty()) {
    line("groups",
         fmt::format("{} of {} shapes instanced, shown {} times as {} shapes", scene.groups.size(),
                     shapes_kept_in_groups(scene), scene.group_instances.size(), shapes_in_groups(scene)));
  }
  if (inventory.named > 0) {
    line("names", fmt::format("{}{}", fmt::join(inventory.names, ", "),
                              inventory.named > inventory.names.size()
                                  ? fmt::format(" and {} more", inventory.named - inventory.names.size())
                                  : ""));
  }
  line("materials", format_counts(inventory.materials));
  line("lights", format_counts(inventory.lights));
  if (inventory.emitters > 0)
    line("emitters", fmt::format("{} surface{}", inventory.emitters, inventory.emitters == 1 ? "" : "s"));
  if (inventory.light_nodes > 0) line("light BVH", fmt::format("{} nodes", inventory.light_nodes));
  line("memory", fmt::format("{} bytes of scene, {} bytes of picture", inventory.bytes,
                             size_t(image.width) * size_t(image.height) * 3 * sizeof(float)));
  for (const auto& file : scene.files) line("read", file.string());
}

Json json_of(const Vec3& v) {
  return {v.x, v.y, v.z};
}

Json json_of(const Counts& counts) {
  Json json = Json::object();
  for (const auto& [name, count] : counts) json[name] = count;
  return json;
}

Json as_json(const Scene& scene, const Inventory& inventory) {
  const CameraAxes camera = camera_axes(scene.camera);
  Json view{{"eye", json_of(camera.eye)},
            {"u", json_of(camera.u)},
            {"v", json_of(camera.v)},
            {"w", json_of(camera.w)},
            {"type", camera_name(scene)}};
  for (const CameraFact& fact : scene.camera.projection->facts(scene.image.size()))
    for (const auto& [name, number] : fact.numbers) view[std::string(name)] = number;
  if (const std::optional<Vec3> point = focus_point(scene)) view["focus_point"] = json_of(*point);
  const Bounds all = extent(scene);
  Json json{
      {"image",
       {{"width", scene.image.width}, {"height", scene.image.height}, {"samples", scene.image.samples}}},
      {"camera", view},
      {"shapes", json_of(inventory.shapes)},
      {"bounds",
       {{"min", is_finite(all) ? json_of(all.min) : Json()},
        {"max", is_finite(all) ? json_of(all.max) : Json()},
        {"unbounded_shapes", unbounded_shapes(scene)}}},
      {"meshes",
       {{"count", scene.meshes.size()},
        {"triangles", inventory.mesh_triangles},
        {"instances", scene.instances.size()}}},
      {"groups",
       {{"count", scene.groups.size()},
        {"shapes", shapes_kept_in_groups(scene)},
        {"instances", scene.group_instances.size()},
        {"shapes_shown", shapes_in_groups(scene)}}},
      {"names", {{"count", inventory.named}, {"first", inventory.names}}},
      {"materials", json_of(inventory.materials)},
      {"lights", json_of(inventory.lights)},
      {"emitters", inventory.emitters},
      {"light_nodes", inventory.light_nodes},
      {"scene_bytes", inventory.bytes},
      {"files", Json::array()},
      {"warnings", Json::array()}};
  for (const auto& file : scene.files) json["files"].push_back(file.string());
  for (const Diagnostic& warning : scene.warnings) json["warnings"].push_back(program::to_json(warning));
  return json;
}

ExitCode CheckCommand::run() const {
  if (schema || manual) {
    fmt::print("{}", schema ? loader::scene_schema() : loader::scene_manual());
    return ExitCode::ok;
  }
  if (scene.file().empty()) throw Error(ExitCode::bad_input, "no scene given (see eyeray check --help)");
  const Scene loaded = scene.load();
  const Inventory inventory = take_inventory(loaded);
  if (json) {
    print_json(as_json(loaded, inventory));
  } else {
    print_text(loaded, inventory);
  }
  return ExitCode::ok;
}

}  // namespace

void add_check(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand(
      "check", "Check a scene without rendering it, and print the values derived from it.");
  const auto options = std::make_shared<CheckCommand>();
  options->scene.add_to(*command);
  command->get_option("SCENE")->required(false);
  command->add_flag("--schema", options->schema, "Print the JSON Schema of scene files, for editors.");
  command->add_flag("--manual", options->manual, "Print the reference of every table and key, as Markdown.");
  command->add_flag("--json", options->json, "Answer as JSON on standard output.");
  command->footer(
      "All errors of the scene are reported at once, as file:line:column: error, with\n"
      "exit code 2.\n"
      "Example: eyeray check scenes/whitted.toml -s 1920x1080");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::engine::cli
