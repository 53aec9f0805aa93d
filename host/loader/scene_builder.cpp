#include "loader/scene_builder.hpp"

#include <algorithm>
#include <map>

#include "loader/mesh_placement.hpp"
#include "loader/sections.hpp"
#include "loader/settings.hpp"
#include "loader/solid_parts.hpp"
#include "scene/affine.hpp"
#include "scene/table.hpp"

namespace eyeray {

namespace {

// Batches of groups in groups multiply: a few lines could show more than any memory holds.
constexpr double most_placed = 0x4000000;
constexpr size_t most_media = 255;  // their number is a byte in the shaders' stack of media

// A batch of a shape's values, as it was checked.
struct Batch {
  const toml::table* lists = nullptr;  // null: the table is one shape
  size_t count = 1;                    // 0 after an error
};

// Where a thing stands, and what it is called.
struct Placing {
  Mat4 to_world{1.0};
  NameRef name;
};

// The name that a table, or an element of its batch, gives itself, where it is one; "" where there is none.
std::string_view written_name(const toml::table& table, const Batch& batch, size_t element) {
  const toml::node* node = table.get("name");
  if (const toml::node* list = batch.lists ? batch.lists->get("name") : nullptr)
    node = list->as_array()->get(element);
  return node && node->is_string() ? std::string_view(node->as_string()->get()) : std::string_view();
}

// How many shapes, meshes and groups a table shows, groups in it included.
double count_placed(const toml::table& table) {
  double members = 1;
  for (const std::string_view name : placed_names()) {
    const toml::node* list = table.get(name);
    if (!list || !list->is_array()) continue;
    for (const toml::node& member : *list->as_array())
      if (member.is_table()) members += count_placed(*member.as_table());
  }
  if (const toml::node* minus = table.get(minus_key); minus && minus->is_table())
    members += count_placed(*minus->as_table()) - 1;
  const toml::node* batch = table.get(batch_key);
  if (!batch || !batch->is_table() || batch->as_table()->empty()) return members;
  const toml::array* values = batch->as_table()->begin()->second.as_array();
  return values ? members * double(values->size()) : members;
}

class Builder {
 public:
  Builder(const toml::table& root, const SceneSources& sources, DiagnosticLog& log)
      : root_(root),
        images_(sources.images),
        meshes_(sources.meshes),
        formulas_(sources.formulas),
        log_(log) {}

  Scene build() {
    TableReader image = read_single("image");
    scene_.image = read_image(image);
    TableReader camera = read_single("camera");
    scene_.camera = read_camera(camera);
    TableReader render = read_single("render");
    scene_.render = read_render(render);

    for_each(root_, "light", [&](const Section& section, const toml::table& table) {
      TableReader light = read_table({section.title, &table, {section.keys}}, log_);
      scene_.lights.push_back(read_light(light));
    });
    for_each(root_, "material",
             [&](const Section& section, const toml::table& table) { add_material(section, table); });
    if (count_placed(root_) <= most_placed)
      add_placed(root_, Placing{});
    else
      log_.error({}, fmt::format("batches and groups show {:.0f} things; at most {:.0f} are possible",
                                 count_placed(root_), most_placed));
    check_whole();
    return std::move(scene_);
  }

 private:
  struct NamedMaterial {
    int index;  // in Scene::materials; -1 after an error
    SourcePosition position;
    bool used = false;
  };

  TableReader read_single(std::string_view name) {
    const Section& section = *find_section(name);
    const toml::node* node = root_.get(name);
    return read_table({section.title, node ? node->as_table() : nullptr, {section.keys}}, log_);
  }

  // Visits the tables of a list; one that should be a list or a table and is not is an error. Returns whether
  // there was none.
  template <typename Visit>
  bool for_each(const toml::table& holder, std::string_view name, const Visit& visit,
                std::string_view holder_name = "group") {
    const toml::node* list = holder.get(name);
    if (!list) return true;
    const Section& section = *find_section(name);
    if (!list->is_array()) {
      log_.error(position_of(list->source()),
                 fmt::format("`{0}` must be a list of tables, written [[{1}.{0}]]", name, holder_name));
      return false;
    }
    bool ok = true;
    for (const toml::node& node : *list->as_array()) {
      if (node.is_table()) {
        visit(section, *node.as_table());
      } else {
        log_.error(position_of(node.source()), fmt::format("every {} must be a table", section.title));
        ok = false;
      }
    }
    return ok;
  }

  void add_material(const Section& section, const toml::table& table);
  void add_placed(const toml::table& holder, const Placing& group);
  template <typename Add>
  size_t for_each_placed(const Section& section, const toml::table& table, const Placing& group,
                         const Add& add);
  std::unique_ptr<Shape> read_shape(const Section& section, const toml::table& table, TableReader& reader,
                                    const Placing& placing);
  std::unique_ptr<Shape> read_solid(const Section& section, const toml::table& table, TableReader& reader,
                                    const Placing& placing, std::optional<int> material);
  std::unique_ptr<Shape> read_part(const Section& section, TableReader& reader, const Placing& placing,
                                   std::optional<int> material);
  bool read_parts(const toml::table& holder, const Placing& solid, std::optional<int> material,
                  ShapeType::Shapes& parts);
  std::unique_ptr<Shape> parse_shape(const Section& section, TableReader& reader, const Placing& placing,
                                     int material);
  void add_mesh(TableReader& reader, const Placing& placing);
  Batch read_batch(const Section& section, const toml::table& table);
  int find_material(TableReader& shape);
  void check_whole();

  const toml::table& root_;
  ImageSource* images_;
  MeshImports* meshes_;
  FormulaSource* formulas_;
  DiagnosticLog& log_;
  Scene scene_;
  std::map<std::string, NamedMaterial, std::less<>> materials_;
  MeshPlacer placer_{scene_};
  size_t media_ = 0;
  bool tried_shapes_ = false;
};

// The type comes first, for it decides which other keys there are.
void Builder::add_material(const Section& section, const toml::table& table) {
  const MaterialType* type = nullptr;
  if (const toml::node* written = table.get("type"); written && written->is_string()) {
    const auto found = std::ranges::find(material_types(), written->as_string()->get(), &MaterialType::name);
    if (found != material_types().end()) type = *found;
  }
  const std::string title = type ? fmt::format("[[material]] of type {}", type->name) : section.title;
  TableReader reader = read_table({.title = title,
                                   .table = &table,
                                   .keys = {section.keys, type ? type->keys : std::span<const Key>()},
                                   .open = !type,
                                   .images = images_},
                                  log_);
  std::unique_ptr<Material> material = type ? type->parse(reader) : nullptr;

  // Enter the name even after an error, so that its users are not reported too.
  const std::string name = reader.string("name");
  if (!reader.valid("name")) return;
  if (name.empty()) return reader.error("name", "a material's name must not be empty");
  const auto [entry, fresh] = materials_.try_emplace(name, NamedMaterial{-1, reader.position()});
  if (!fresh) {
    const SourcePosition& first = entry->second.position;
    return reader.error("name", fmt::format("material \"{}\" is defined twice; the first is at {}:{}", name,
                                            first.file, first.line));
  }
  if (!material) return;
  if (material->medium() && ++media_ > most_media) {
    reader.error("type",
                 fmt::format("a scene can have at most {} materials that light passes through", most_media));
  }
  if (reader.has("alpha")) {
    if (material->medium())
      reader.error("alpha", "what light passes through fills its shape, which can have no holes");
    material->mask = AlphaMask{reader.texture("alpha"), reader.number("alpha_cutoff")};
  } else if (reader.has("alpha_cutoff")) {
    reader.error("alpha_cutoff", "without `alpha` there is nothing to cut off");
  }
  material->name = name;
  entry->second.index = static_cast<int>(scene_.materials.size());
  scene_.materials.push_back(std::move(material));
}

// Checks that all lists of a batch are lists of the shape's values, and equally long.
Batch Builder::read_batch(const Section& section, const toml::table& table) {
  const toml::node* node = table.get(batch_key);
  if (!node) return {};
  const toml::table* lists = node->as_table();
  if (!lists || lists->empty()) {
    log_.error(position_of(node->source()), "`batch` must be a table of lists, such as { KEY = [value, …] }");
    return {nullptr, 0};
  }
  std::vector<std::string_view> names;
  for (const std::span<const Key> keys :
       {section.keys, section.shape ? section.shape->keys : std::span<const Key>()}) {
    for (const Key& key : keys) names.push_back(key.name);
  }
  Batch batch{lists, 0};
  bool ok = true;
  const auto fail = [&](const toml::source_region& at, std::string message) {
    log_.error(position_of(at), std::move(message));
    ok = false;
  };
  const toml::key* first = nullptr;
  for (const auto& [key, list] : *lists) {
    if (std::ranges::find(names, key.str()) == names.end()) {
      const std::string nearest = nearest_name(key.str(), names);
      fail(key.source(), fmt::format("unknown key `{}` in the batch of {}{}", key.str(), section.title,
                                     nearest.empty() ? "" : fmt::format("; did you mean `{}`?", nearest)));
    } else if (table.contains(key.str())) {
      fail(key.source(), fmt::format("`{}` stands in the table and in its batch", key.str()));
    } else if (!list.is_array()) {
      fail(list.source(), fmt::format("`{}` in a batch must be a list, one value each", key.str()));
    } else if (!first) {
      first = &key;
      batch.count = list.as_array()->size();
    } else if (list.as_array()->size() != batch.count) {
      fail(list.source(),
           fmt::format("`{}` has {} values, `{}` has {}: the lists of a batch are equally long", key.str(),
                       list.as_array()->size(), first->str(), batch.count));
    }
  }
  return ok ? batch : Batch{nullptr, 0};
}

// The shapes, meshes and groups of a group, or of the scene.
void Builder::add_placed(const toml::table& holder, const Placing& group) {
  for (const std::string_view name : placed_names()) {
    for_each(holder, name, [&](const Section& section, const toml::table& table) {
      for_each_placed(section, table, group, [&](TableReader& reader, const Placing& placed) {
        switch (section.kind) {
          case Section::Kind::group:
            return add_placed(table, placed);
          case Section::Kind::mesh:
            return add_mesh(reader, placed);
          default:
            if (auto shape = read_shape(section, table, reader, placed))
              scene_.shapes.push_back(std::move(shape));
        }
      });
    });
  }
}

// Calls add(reader, to_world) for the table, or for each element of its batch. Returns how many these are.
template <typename Add>
size_t Builder::for_each_placed(const Section& section, const toml::table& table, const Placing& group,
                                const Add& add) {
  Placing placed{group.to_world, {group.name.index, false}};
  const DiagnosticLog::About about(log_, [&] {
    return placed.name.index == Names::none ? "" : describe(section.name, placed.name, scene_.names);
  });
  const Batch batch = read_batch(section, table);
  std::vector<std::string_view> elsewhere{batch_key};
  if (section.kind == Section::Kind::group || section.is_combined())
    elsewhere.insert(elsewhere.end(), placed_names().begin(), placed_names().end());
  if (section.is_combined()) elsewhere.push_back(minus_key);
  if (section.kind != Section::Kind::group) tried_shapes_ = true;
  for (size_t i = 0; i < batch.count; ++i) {
    placed.name = {group.name.index, false};
    if (const std::string_view name = written_name(table, batch, i); !name.empty()) {
      // Of one name there are as many as the batch has elements.
      const bool shared = batch.lists && !batch.lists->contains("name");
      placed.name = {scene_.names.add(name, shared ? uint32_t(i + 1) : 0, group.name.index), true};
    }
    TableReader reader = read_table({.title = section.title,
                                     .table = &table,
                                     .keys = {section.shape ? section.shape->keys : section.keys,
                                              section.shape ? section.keys : std::span<const Key>()},
                                     .batch = batch.lists,
                                     .element = i,
                                     .extra_keys = elsewhere,
                                     .formulas = formulas_},
                                    log_);
    if (reader.has("name") && reader.valid("name") && reader.string("name").empty())
      reader.error("name", "a name must not be empty; leave `name` out instead");
    placed.to_world = group.to_world * reader.transform("transform");
    if (const std::string why = why_singular(placed.to_world); !why.empty())
      reader.error("transform",
                   fmt::format("with the transforms of its groups, the map cannot be undone: {}", why));
    else
      add(reader, placed);
  }
  return batch.count;
}

std::unique_ptr<Shape> Builder::read_shape(const Section& section, const toml::table& table,
                                           TableReader& reader, const Placing& placing) {
  if (section.is_combined()) return read_solid(section, table, reader, placing, std::nullopt);
  return parse_shape(section, reader, placing, find_material(reader));
}

// A shape of its own, or a part.
std::unique_ptr<Shape> Builder::parse_shape(const Section& section, TableReader& reader,
                                            const Placing& placing, int material) {
  std::unique_ptr<Shape> shape = section.shape->parse(reader, placing.to_world);
  if (!shape) return nullptr;
  if (!section.shape->flat && !scene_.materials.empty() && scene_.materials[size_t(material)]->mask)
    reader.error(
        "material",
        fmt::format(
            "a material with `alpha` has holes, and a ray may meet a {} again behind one; only planes, "
            "triangles, polygons, parallelograms, disks and meshes can be of it",
            section.shape->name));
  shape->material = material;
  shape->type = section.shape;
  shape->name = placing.name;
  shape->position = reader.position();
  return shape;
}

// `material`: of the solid around it.
std::unique_ptr<Shape> Builder::read_solid(const Section& section, const toml::table& table,
                                           TableReader& reader, const Placing& placing,
                                           std::optional<int> material) {
  if (reader.has("material")) material = find_material(reader);
  ShapeType::Shapes operands, removed;
  bool ok = read_parts(table, placing, material, operands);
  if (const toml::node* minus = table.get(minus_key)) {
    if (const toml::table* held = minus->as_table()) {
      for (const auto& [key, node] : *held) {
        if (std::ranges::find(placed_names(), key.str()) != placed_names().end()) continue;
        log_.error(position_of(key.source()),
                   fmt::format("unknown key `{}` in `minus`, which holds shapes alone", key.str()));
        ok = false;
      }
      ok = read_parts(*held, placing, material, removed) && ok;
    } else {
      log_.error(position_of(minus->source()), "`minus` must be a table, written [[solid.minus.sphere]]");
      ok = false;
    }
  }
  if (!ok) return nullptr;
  auto solid = section.shape->combine(reader, std::move(operands), std::move(removed));
  if (!solid) return nullptr;
  if (const std::string why = why_two_media(*solid, scene_.materials); !why.empty())
    reader.error("material", why);
  solid->material = material.value_or(0);
  solid->type = section.shape;
  solid->name = placing.name;
  solid->position = reader.position();
  return solid;
}

// Adds the shapes that stand in a solid's table to `parts`. Returns whether all of them are right.
bool Builder::read_parts(const toml::table& holder, const Placing& solid, std::optional<int> material,
                         ShapeType::Shapes& parts) {
  bool ok = true;
  for (const std::string_view name : placed_names()) {
    const auto add_part = [&](const Section& written, const toml::table& table) {
      if (const std::string why = why_no_part(written); !why.empty()) {
        log_.error(position_of(table.source()), why);
        ok = false;
        return;
      }
      Section section = written;
      section.keys = part_keys();
      size_t added = 0;
      const size_t wanted =
          for_each_placed(section, table, solid, [&](TableReader& reader, const Placing& placed) {
            auto part = section.is_combined() ? read_solid(section, table, reader, placed, material)
                                              : read_part(section, reader, placed, material);
            if (!part) return;
            parts.push_back(std::move(part));
            ++added;
          });
      ok = ok && wanted > 0 && added == wanted;
    };
    ok = for_each(holder, name, add_part, "solid") && ok;
  }
  return ok;
}

// `material`: of the solid that it is in.
std::unique_ptr<Shape> Builder::read_part(const Section& section, TableReader& reader, const Placing& placing,
                                          std::optional<int> material) {
  if (reader.has("material")) {
    material = find_material(reader);
  } else if (!material) {
    reader.error("material",
                 fmt::format("no material: neither this {} nor a solid around it has one", section.title));
  }
  std::unique_ptr<Shape> part = parse_shape(section, reader, placing, material.value_or(0));
  if (!part || !material) return nullptr;
  if (!part->is_closed()) {
    const auto& [key, why] = why_not_closed(*section.shape);
    reader.error(key, why);
    return nullptr;
  }
  return part;
}

void Builder::add_mesh(TableReader& reader, const Placing& placing) {
  const bool own_materials = !reader.has("material");
  const int material = own_materials ? 0 : find_material(reader);
  if (reader.failed()) return;
  if (!meshes_) return reader.error("file", "only a scene in a file can name mesh files");
  const std::optional<double> smooth =
      reader.has("smooth") ? std::optional(reader.number("smooth")) : std::nullopt;
  try {
    const auto [import, fresh] = meshes_->load(reader.string("file"), smooth, reader.position("file").file);
    if (fresh) {
      for (const std::string& warning : import->warnings) log_.warning(reader.position(), warning);
    }
    const std::string wrong =
        placer_.place(*import, placing.to_world, own_materials ? std::nullopt : std::optional(material),
                      reader.position(), placing.name);
    if (!wrong.empty()) reader.error("transform", wrong);
  } catch (const Error& refused) {
    reader.error("file", refused.what());
  }
}

int Builder::find_material(TableReader& shape) {
  if (!shape.valid("material")) return 0;
  const std::string name = shape.string("material");
  const auto found = materials_.find(name);
  if (found != materials_.end()) {
    found->second.used = true;
    return std::max(0, found->second.index);
  }
  if (log_.damaged()) return 0;
  std::vector<std::string_view> names;
  for (const auto& [known, material] : materials_) names.push_back(known);
  const std::string nearest = nearest_name(name, names);
  shape.error("material", fmt::format("no [[material]] is named \"{}\"{}", name,
                                      nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest)));
  return 0;
}

// Warns of what is legal but hardly meant.
void Builder::check_whole() {
  const bool empty = scene_.shapes.empty() && scene_.instances.empty();
  if (empty && !tried_shapes_) log_.warning({}, "the scene has no shapes: only background will be seen");
  if (scene_.lights.empty() && scene_.render.integrator == IntegratorType::whitted && !empty) {
    log_.warning({}, "the scene has no [[light]]: shapes are lit by `ambient` of [render] only");
  }
  const auto is_medium = [](const auto& material) { return material->medium().has_value(); };
  if (std::ranges::count_if(scene_.materials, is_medium) > std::ptrdiff_t{most_media}) {
    log_.error({},
               fmt::format("a scene can have at most {} materials that light passes through, those of its "
                           "mesh files included",
                           most_media));
  }
  for (const auto& [name, material] : materials_) {
    if (!material.used) log_.warning(material.position, fmt::format("material \"{}\" is not used", name));
  }
}

}  // namespace

Scene build_scene(const toml::table& root, const SceneSources& sources, DiagnosticLog& log) {
  return Builder(root, sources, log).build();
}

}  // namespace eyeray
