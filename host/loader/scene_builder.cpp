#include "host/loader/scene_builder.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "host/loader/area_lights.hpp"
#include "host/loader/batch.hpp"
#include "host/loader/cameras.hpp"
#include "host/loader/csg_reader.hpp"
#include "host/loader/environments.hpp"
#include "host/loader/group_placement.hpp"
#include "host/loader/group_plan.hpp"
#include "host/loader/lights.hpp"
#include "host/loader/materials.hpp"
#include "host/loader/medium.hpp"
#include "host/loader/mesh_placement.hpp"
#include "host/loader/mesh_reading.hpp"
#include "host/loader/path_check.hpp"
#include "host/loader/photon_check.hpp"
#include "host/loader/sections.hpp"
#include "host/loader/settings.hpp"
#include "host/loader/tables.hpp"
#include "host/loader/variables.hpp"
#include "host/reading/source_position.hpp"
#include "host/reading/table.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/tangents.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::loader {

namespace {

// Limit on lights. Each light costs an iteration and a shadow ray at every hit. So many lights fit even into
// a driver's limit of 65 535 iterations a loop, for a scene with 24 shapes and no BVH (docs/lavapipe.md).
constexpr size_t most_lights = 2048;

// The placement and the name of an object.
struct Placing {
  Mat4 to_world{1.0};
  NameRef name;
};

class Builder {
 public:
  Builder(const toml::table& root, const SceneSources& sources, DiagnosticLog& log)
      : root_(root),
        variables_(read_let(root, log)),
        values_{.formulas = sources.formulas,
                .images = sources.images,
                .fonts = sources.fonts,
                .textures = textures::types(),
                .variables = &variables_},
        meshes_(sources.meshes),
        log_(log) {}

  Scene build() {
    scene_.camera = read_camera(*find_section("camera"), single("camera"), values_, log_);
    reading::TableReader render = read_single("render");
    scene_.render = read_render(render);
    reading::TableReader image = read_single("image");
    scene_.image = read_image(image, scene_.render.integrator);
    const toml::table* around = single("environment");
    Surroundings surroundings = read_environment(*find_section("environment"), around, values_, log_);
    scene_.environment = std::move(surroundings.map);
    if (around && render.has("background"))
      render.error("background",
                   "[environment] takes the place of `background`: a scene has one or the other");
    reading::TableReader medium = read_single("medium");
    scene_.medium = read_medium(medium, scene_.render.integrator);
    scene_.medium_extent = read_medium_extent(medium);
    reading::TableReader verify = read_single("verify");
    scene_.verify = read_verify(verify);

    for_each_table(root_, "light", log_,
                   [&](const Section& section, const toml::table& table) { add_lights(section, table); });
    if (surroundings.sun) {
      scene_.lights.push_back(std::move(surroundings.sun));
      light_positions_.push_back(reading::position_of(around->source()));
    }
    for_each_table(root_, "material", log_,
                   [&](const Section& section, const toml::table& table) { materials_.add(section, table); });
    plan_.emplace(root_, scene_.render.groups, variables_, log_);
    if (plan_->sound()) {
      add_placed(root_, Placing{});
      check_idle_patterns();
    }
    check_whole(render);
    if (!log_.has_errors()) make_tangents(scene_);
    return std::move(scene_);
  }

 private:
  friend class loader::CsgReader<Builder>;

  // The table of that name; null if it is not written.
  const toml::table* single(std::string_view name) const {
    const toml::node* node = root_.get(name);
    return node ? node->as_table() : nullptr;
  }

  reading::TableReader read_single(std::string_view name) {
    const Section& section = *find_section(name);
    return reading::read_table(
        {.title = section.title, .table = single(name), .keys = {section.keys}, .sources = values_}, log_);
  }

  void add_lights(const Section& section, const toml::table& table);
  void add_placed(const toml::table& holder, const Placing& group);
  void add_area_lights(std::string_view shape);
  void add_table(const Section& section, const toml::table& table, const Placing& group);
  template <typename Add>
  size_t for_each_placed(const Section& section, const toml::table& table, const Placing& group,
                         const Add& add);
  std::unique_ptr<Shape> read_shape(const Section& section, const toml::table& table,
                                    reading::TableReader& reader, const Placing& placing);
  std::unique_ptr<Shape> parse_shape(const Section& section, reading::TableReader& reader,
                                     const Placing& placing, int material);
  void add_mesh(reading::TableReader& reader, const Placing& placing);
  void add_group(reading::TableReader& reader, const toml::table& table, const Placing& placing);
  void add_instance(reading::TableReader& reader, const Placing& placing);
  Group build_group(const toml::table& table, const Mat4& to_world);
  void check_idle_patterns();
  void check_whole(reading::TableReader& render);

  const toml::table& root_;
  reading::Variables variables_;
  const reading::ValueSources values_;
  MeshImports* meshes_;
  DiagnosticLog& log_;
  Scene scene_;
  Materials materials_{scene_, values_, log_};
  MeshPlacer placer_{scene_};
  std::optional<GroupPlan> plan_;
  GroupPlacer group_placer_{scene_, placer_};
  std::map<const toml::table*, int> instanced_groups_;  // indices in Scene::groups
  double worst_condition_ = 0;  // worst condition number of all maps since the current group was begun
  Group* building_ = nullptr;   // receives shapes and meshes; null: the scene does
  size_t lights_ = 0;
  std::vector<SourcePosition> light_positions_ = {};  // one for each of scene_.lights
  std::vector<std::pair<const AreaShape*, const toml::table*>> area_lights_ = {};
  bool tried_shapes_ = false;
};

// Adds the lights of a table, but notes an area light for later.
void Builder::add_lights(const Section& section, const toml::table& table) {
  if (is_area_light(table)) {
    if (const AreaShape* shape = area_shape(table, values_, log_)) area_lights_.push_back({shape, &table});
    return;
  }
  const Repeat repeat = read_repeat(table, variables_, log_);
  for (size_t i = 0; i < repeat.count; ++i) {
    const LoopScope scope(variables_, repeat, i);
    if (++lights_ == most_lights + 1) {
      log_.error(reading::position_of(table.source()),
                 fmt::format("a scene can have at most {} lights", most_lights));
    }
    if (lights_ > most_lights) return;
    if (std::unique_ptr<Light> light = read_light(section, table, values_, log_)) {
      scene_.lights.push_back(std::move(light));
      light_positions_.push_back(reading::position_of(table.source()));
    }
  }
}

// Adds the shapes, meshes and groups of a group, or of the scene.
void Builder::add_placed(const toml::table& holder, const Placing& group) {
  for (const std::string_view name : placed_names()) {
    for_each_table(holder, name, log_, [&](const Section& section, const toml::table& table) {
      // Skip a pattern: only instances show it.
      if (section.kind == Section::Kind::group && GroupPlan::is_pattern(table)) return;
      add_table(section, table, group);
    });
    // The points and lines of mesh files follow the shapes of tables: Scene::shapes are in registry order.
    placer_.take_shapes(name, building_ ? building_->shapes : scene_.shapes);
    if (&holder == &root_) add_area_lights(name);
  }
}

// Adds the area lights that have this shape, so that Scene::shapes stay in registry order.
void Builder::add_area_lights(std::string_view shape) {
  for (const auto& [named, table] : area_lights_) {
    const Section& light = named->section;
    if (light.shape->name != shape) continue;
    for_each_placed(light, *table, Placing{}, [&](reading::TableReader& reader, const Placing& placed) {
      if (auto made = parse_shape(light, reader, placed, -1)) {  // no material yet
        made->material = materials_.emitter(radiance_of(*made, reader), reader.choice("emission_side") == 1);
        scene_.shapes.push_back(std::move(made));
      }
    });
  }
}

void Builder::add_table(const Section& section, const toml::table& table, const Placing& group) {
  for_each_placed(section, table, group, [&](reading::TableReader& reader, const Placing& placed) {
    switch (section.kind) {
      case Section::Kind::group:
        return add_group(reader, table, placed);
      case Section::Kind::instance:
        return add_instance(reader, placed);
      case Section::Kind::mesh:
        return add_mesh(reader, placed);
      default:
        if (auto shape = read_shape(section, table, reader, placed))
          (building_ ? building_->shapes : scene_.shapes).push_back(std::move(shape));
    }
  });
}

// Builds a group by itself, outside the scene. Names in it do not include the group's own name, which each of
// its instances adds.
Group Builder::build_group(const toml::table& table, const Mat4& to_world) {
  Group group;
  Group* const outer = std::exchange(building_, &group);
  add_placed(table, {to_world, {}});
  building_ = outer;
  return group;
}

void Builder::add_group(reading::TableReader& reader, const toml::table& table, const Placing& placing) {
  if (building_ || !plan_->is_instanced(table)) return add_placed(table, placing);
  const auto [entry, fresh] = instanced_groups_.try_emplace(&table);
  if (fresh) {
    worst_condition_ = 0;
    Group group = build_group(table, Mat4(1.0));
    entry->second = group_placer_.keep(std::move(group), worst_condition_);
  }
  // Instancing must not decide whether a scene is valid. If the group may not fit at this transform, read it
  // there once more for its errors.
  if (!group_placer_.surely_fits(entry->second, placing.to_world)) build_group(table, placing.to_world);
  group_placer_.place(entry->second, placing.to_world, reader.position(), placing.name);
}

void Builder::add_instance(reading::TableReader& reader, const Placing& placing) {
  if (!reader.valid("group")) return;
  const std::string name = reader.string("group");
  if (const toml::table* group = plan_->find(name)) {
    const auto around = std::exchange(variables_.loops, {});
    add_table(*find_section("group"), *group, placing);
    variables_.loops = around;
    return;
  }
  if (log_.damaged()) return;
  const std::string nearest = nearest_name(name, plan_->names());
  reader.error("group", fmt::format("no [[group]] is named \"{}\"{}", name,
                                    nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest)));
}

// Reports the errors in patterns that no instance shows, and warns of these patterns.
void Builder::check_idle_patterns() {
  for (const toml::table* group : plan_->idle()) {
    Group unused;
    building_ = &unused;
    add_table(*find_section("group"), *group, Placing{});
    building_ = nullptr;
    log_.warning(reading::position_of(group->source()),
                 fmt::format("group \"{}\" is not shown: no [[instance]] names it",
                             (*group)["name"].value_or(std::string())));
  }
}

// Calls add(reader, placing) for the table, for each element of its batch, or for each of its repetitions.
// Returns their number.
template <typename Add>
size_t Builder::for_each_placed(const Section& section, const toml::table& table, const Placing& group,
                                const Add& add) {
  Placing placed{group.to_world, {group.name.index, false}};
  const DiagnosticLog::About about(log_, [&] {
    return placed.name.index == Names::none ? "" : describe(section.name, placed.name, scene_.names);
  });
  const Batch batch = read_batch(section, table, log_);
  const Repeat repeat = read_repeat(table, variables_, log_);
  const size_t count = batch.count * repeat.count;  // one of them is 1, or 0
  std::vector<std::string_view> elsewhere{batch_key, repeat_key};
  if (section.kind == Section::Kind::group || section.is_combined())
    elsewhere.insert(elsewhere.end(), placed_names().begin(), placed_names().end());
  if (section.is_combined()) elsewhere.push_back(minus_key);
  if (section.kind != Section::Kind::group) tried_shapes_ = true;
  for (size_t i = 0; i < count; ++i) {
    const LoopScope scope(variables_, repeat, i);
    placed.name = {group.name.index, false};
    if (const std::string_view name = written_name(table, batch, i); !name.empty()) {
      // If the batch does not list names, its elements have the table's name and a number, as repetitions do.
      const bool shared = batch.lists ? !batch.lists->contains("name") : !repeat.counters.empty();
      placed.name = {scene_.names.add(name, shared ? uint32_t(i + 1) : 0, group.name.index), true};
    }
    reading::TableReader reader =
        reading::read_table({.title = section.title,
                             .table = &table,
                             .keys = {section.shape ? section.shape->keys : section.keys,
                                      section.shape ? section.keys : std::span<const reading::Key>()},
                             .batch = batch.lists,
                             .element = i,
                             .extra_keys = elsewhere,
                             .sources = values_},
                            log_);
    if (reader.has("name") && reader.valid("name") && reader.string("name").empty())
      reader.error("name", "a name must not be empty; leave `name` out instead");
    placed.to_world = group.to_world * reader.transform("transform");
    if (const std::string why = why_singular(placed.to_world); !why.empty()) {
      reader.error(
          "transform",
          fmt::format("together with the transforms of its groups, `transform` cannot be inverted: {}", why));
      continue;
    }
    worst_condition_ = std::max(worst_condition_, condition(Mat3(placed.to_world)));
    add(reader, placed);
  }
  return count;
}

std::unique_ptr<Shape> Builder::read_shape(const Section& section, const toml::table& table,
                                           reading::TableReader& reader, const Placing& placing) {
  if (section.is_combined())
    return CsgReader(*this, log_).read(section, table, reader, placing, std::nullopt);
  return parse_shape(section, reader, placing, materials_.find(reader));
}

// Reads a shape, or a part of a CSG object.
std::unique_ptr<Shape> Builder::parse_shape(const Section& section, reading::TableReader& reader,
                                            const Placing& placing, int material) {
  std::unique_ptr<Shape> shape = section.shape->parse(reader, placing.to_world);
  if (!shape) return nullptr;
  if (section.shape->overlaps)
    materials_.check_opaque(reader, material);
  else if (!section.shape->flat && material >= 0 && !scene_.materials.empty() &&
           scene_.materials[size_t(material)]->mask)
    reader.error(
        "material",
        fmt::format("a material with `alpha` has cutouts, and a ray may hit the {} again behind one; only "
                    "planes, triangles, polygons, parallelograms, disks and meshes can have such a material",
                    section.shape->name));
  shape->material = material;
  shape->type = section.shape->name;
  shape->name = placing.name;
  shape->position = reader.position();
  return shape;
}

void Builder::add_mesh(reading::TableReader& reader, const Placing& placing) {
  const bool own_materials = !reader.has("material");
  const int material = own_materials ? 0 : materials_.find(reader);
  if (reader.failed()) return;
  if (!meshes_) return reader.error("file", "only a scene in a file can name mesh files");
  const importers::ImportOptions reading = read_mesh_reading(reader);
  try {
    const auto [import, fresh] = meshes_->load(reader.string("file"), reading, reader.position("file").file);
    if (!check_mesh_names(reading, *import, reader)) return;
    if (fresh) {
      for (const std::string& warning : import->warnings) log_.warning(reader.position(), warning);
    }
    const MeshPlacer::Placing placed{placing.to_world, own_materials ? std::nullopt : std::optional(material),
                                     reader.position(), placing.name};
    std::string wrong = placer_.place(*import, placed, building_ ? building_->instances : scene_.instances);
    if (wrong.empty()) wrong = placer_.place_shapes(*import, placed);
    if (!wrong.empty()) reader.error("transform", wrong);
    if (!own_materials && !(import->clouds.empty() && import->lines.empty()))
      materials_.check_opaque(reader, material);
  } catch (const Error& refused) {
    reader.error("file", refused.what());
  }
}

// Warns of a valid scene that its author has probably not intended.
void Builder::check_whole(reading::TableReader& render) {
  const bool empty = scene_.shapes.empty() && scene_.instances.empty() && scene_.group_instances.empty();
  if (empty && !tried_shapes_) log_.warning({}, "the scene has no shapes: only background will be seen");
  if (traits_of(scene_.render.integrator).shadow_rays == ShadowRays::each_light && !empty) {
    if (scene_.lights.empty() && area_lights_.empty())
      log_.warning({}, "the scene has no [[light]]: shapes are lit by `ambient` of [render] only");
    if (!area_lights_.empty())
      log_.warning(reading::position_of(area_lights_.front().second->source()),
                   fmt::format("integrator = \"{}\" shows area lights, but they illuminate nothing; \"path\" "
                               "and \"sppm\" sample them",
                               integrator_names[size_t(scene_.render.integrator)]));
  }
  if (walks_at_random(scene_.render.integrator) && !empty && !log_.has_errors()) warn_of_paths(scene_, log_);
  if (sends_photons(scene_.render.integrator) && !log_.has_errors())
    prepare_for_photons(scene_, render, light_positions_, log_);
  materials_.check();
}

}  // namespace

Scene build_scene(const toml::table& root, const SceneSources& sources, DiagnosticLog& log) {
  return Builder(root, sources, log).build();
}

}  // namespace eyeray::engine::loader
