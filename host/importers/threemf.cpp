// Reads 3MF: a package of XML, with objects, their colours and pictures, and a build with their transforms.
// Sources: threemf_model.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "host/core/free_memory.hpp"
#include "host/image/coded_image.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/malformed.hpp"
#include "host/importers/mesh_builder.hpp"
#include "host/importers/texture_files.hpp"
#include "host/importers/threemf_model.hpp"
#include "host/materials/make.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/image_texture_file.hpp"

namespace eyeray::engine::importers {

namespace {

// Limits on components: their nesting, and the objects of a build, each with all its components.
constexpr int most_nested = 32;
constexpr size_t most_placed = size_t{1} << 20;

// The colour of triangles without one, in an object where others have one: that of plain_material().
constexpr double bare_gray = 0.75;

// The values of an object's corners, each once: the pool's index of a group's value.
class CornerValues {
 public:
  // `add`: appends the value to the pool, and returns its index.
  template <typename Add>
  uint32_t find(uint32_t group, uint32_t index, Add add) {
    const auto [entry, fresh] = known_.try_emplace(uint64_t{group} << 32 | index, 0);
    if (fresh) entry->second = add();
    return entry->second;
  }

 private:
  std::unordered_map<uint64_t, uint32_t> known_;
};

// Appends to a list, and returns the index.
template <typename Value>
uint32_t append(std::vector<Value>& list, const Value& value) {
  list.push_back(value);
  return static_cast<uint32_t>(list.size() - 1);
}

class ThreeMfReader {
 public:
  explicit ThreeMfReader(MeshFile& file)
      : file_(file), parts_(file.bytes, file.name), textures_(file.assets, *file.pixels, scene.warnings) {}

  void read() {
    const std::string root = ZipParts::key(find_threemf_root(parts_, file_.name));
    const std::vector<ThreeMfPlacing> items = model(root).items;
    const Mat4 unit(Mat3(model(root).millimetres));
    for (const ThreeMfPlacing& item : items) place(root, item, unit, 0);
    if (items.empty())
      scene.warnings.emplace_back("its build is empty, so that none of its objects is shown");
    report();
  }

  ImportedScene scene;

 private:
  // A mesh of the scene, and its material.
  struct Shown {
    int mesh, material;
  };
  using ObjectKey = std::pair<std::string, uint32_t>;

  ThreeMfModel& model(const std::string& part);
  void place(const std::string& part, const ThreeMfPlacing& placing, const Mat4& onto, int depth);
  const std::vector<Shown>& meshes_of(const ObjectKey& key);
  void build(const ThreeMfModel& model, ThreeMfObject& object, std::vector<Shown>& shown);
  int material_of(const ThreeMfModel& model, uint32_t picture);
  void report();

  MeshFile& file_;
  ZipParts parts_;
  TextureFiles textures_;
  std::map<std::string, ThreeMfModel> models_;  // by the key of their part
  std::map<ObjectKey, std::vector<Shown>> meshes_;
  std::map<ObjectKey, int> materials_;  // by the id of their picture
  std::set<ObjectKey> open_;            // the objects that are being placed
  size_t placed_ = 0, singular_ = 0;
  MeshCounts counts_;
};

ThreeMfModel& ThreeMfReader::model(const std::string& part) {
  const auto found = models_.find(part);
  if (found != models_.end()) return found->second;
  return models_.emplace(part, read_threemf_model(parts_, part, file_.name)).first->second;
}

// Adds instances of an object and of its components.
void ThreeMfReader::place(const std::string& part, const ThreeMfPlacing& placing, const Mat4& onto,
                          int depth) {
  const std::string& from = models_.at(part).name;
  const auto fail = [&](const std::string& why) {
    return malformed(from, why, placing.line, placing.column);
  };
  const ObjectKey key{placing.part.empty() ? part : ZipParts::key(placing.part), placing.object};
  if (!parts_.has(key.first)) throw fail(fmt::format("the file has no part {}", placing.part));
  ThreeMfModel& target = model(key.first);
  const auto found = target.objects.find(key.second);
  if (found == target.objects.end()) throw fail(fmt::format("there is no object {}", key.second));
  if (!open_.insert(key).second) throw fail(fmt::format("object {} contains itself", key.second));
  if (depth > most_nested) throw fail(fmt::format("components are nested more than {} deep", most_nested));
  if (++placed_ > most_placed)
    throw fail(fmt::format("the build has more than {} objects, with all their components", most_placed));

  const Mat4 transform = onto * placing.transform;
  if (why_singular(transform).empty()) {
    for (const Shown& each : meshes_of(key))
      scene.instances.push_back({each.mesh, transform, each.material, {}});
  } else {
    ++singular_;
  }
  const std::vector<ThreeMfPlacing>& components = found->second.components;
  for (const ThreeMfPlacing& component : components) place(key.first, component, transform, depth + 1);
  open_.erase(key);
}

const std::vector<ThreeMfReader::Shown>& ThreeMfReader::meshes_of(const ObjectKey& key) {
  const auto [entry, fresh] = meshes_.try_emplace(key);
  if (fresh) {
    const ThreeMfModel& from = models_.at(key.first);
    ThreeMfObject& object = models_.at(key.first).objects.at(key.second);
    if (!object.triangles.empty()) build(from, object, entry->second);
  }
  return entry->second;
}

// Makes the meshes of an object: one for its triangles with colours or without properties, and one for each
// picture. Frees the lists that they were made from.
void ThreeMfReader::build(const ThreeMfModel& model, ThreeMfObject& object, std::vector<Shown>& shown) {
  VertexPool pool;
  pool.positions = std::move(object.positions);
  std::map<uint32_t, RawTriangles> lists;  // by picture; 0: those without
  CornerValues colors, uv;
  bool any_color = false;
  const auto property_of = [&](size_t i) {
    return object.properties.empty() ? object.whole : object.properties[i];
  };
  const auto group_of = [&](const ThreeMfProperty& property) -> const ThreeMfGroup* {
    if (property.group == ThreeMfProperty::no_group) return nullptr;
    const ThreeMfGroup& group = model.groups.at(property.group);
    return group.kind == ThreeMfGroup::Kind::other ? nullptr : &group;
  };
  for (size_t i = 0; i < object.triangles.size() && !any_color; ++i) {
    const ThreeMfGroup* group = group_of(property_of(i));
    any_color = group && group->kind == ThreeMfGroup::Kind::colors;
  }
  for (size_t i = 0; i < object.triangles.size(); ++i) {
    const ThreeMfProperty property = property_of(i);
    const ThreeMfGroup* group = group_of(property);
    const bool pictured = group && group->kind == ThreeMfGroup::Kind::texture;
    RawTriangles& list = lists[pictured ? group->texture : 0];
    list.positions.push_back(object.triangles[i]);
    if (pictured) {
      IndexTriangle& corners = list.uv.emplace_back();
      for (size_t k = 0; k < 3; ++k)
        corners[k] = uv.find(property.group, property.corners[k],
                             [&] { return append(pool.uv, group->uv[property.corners[k]]); });
    }
    if (!any_color) continue;
    IndexTriangle& corners = list.corner_colors.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      const bool colored = group && !pictured;
      corners[k] =
          colors.find(colored ? property.group : 0, colored ? property.corners[k] : uint32_t{pictured}, [&] {
            return append(pool.colors, colored    ? group->colors[property.corners[k]]
                                       : pictured ? Vec3(1)
                                                  : Vec3(bare_gray));
          });
    }
  }
  object.triangles = {};
  object.properties = {};
  MeshBuilder builder(pool, counts_);
  for (auto& [picture, list] : lists) {
    list.name = object.name.empty() ? file_.name : fmt::format("{}, {}", file_.name, object.name);
    list.has_uv = picture != 0;
    shown.push_back({static_cast<int>(scene.meshes.size()), picture != 0 ? material_of(model, picture) : -1});
    scene.meshes.push_back(builder.build(list, file_.options.smooth.value_or(default_smooth)));
  }
}

// The material with a picture, or −1 if it cannot be read.
int ThreeMfReader::material_of(const ThreeMfModel& model, uint32_t id) {
  const auto [entry, fresh] = materials_.try_emplace({model.name, id}, -1);
  if (!fresh) return entry->second;
  const ThreeMfPicture& written = model.pictures.at(id);
  const auto decoded =
      textures_.load(fmt::format("{}, {}", model.name, id),
                     [&](image::PixelBudget& budget, std::vector<std::string>& warnings) {
                       const std::string bytes = parts_.read(written.part);
                       ImageTexture image = decode_image_texture(
                           std::as_bytes(std::span(bytes)), fmt::format("{}, {}", file_.name, written.part),
                           budget, warnings);
                       image.filter = written.filter;
                       image.wrap_u = written.wrap_u;
                       image.wrap_v = written.wrap_v;
                       return image;
                     });
  if (!decoded) return -1;
  entry->second = static_cast<int>(scene.materials.size());
  scene.materials.push_back(materials::make_phong({.diffuse = textures::make_image(decoded)}));
  return entry->second;
}

void ThreeMfReader::report() {
  std::map<std::string, size_t> left_out;
  for (const auto& [part, model] : models_)
    for (const auto& [words, count] : model.left_out) left_out[words] += count;
  for (const auto& [words, count] : left_out) scene.warnings.push_back(fmt::format("{}: {}", words, count));
  if (singular_ > 0)
    scene.warnings.push_back(
        fmt::format("objects whose transforms cannot be inverted were left out: {}", singular_));
  counts_.report(scene.warnings);
}

}  // namespace

ImportedScene import_3mf(MeshFile& file) {
  ThreeMfReader reader(file);
  reader.read();
  return std::move(reader.scene);
}

}  // namespace eyeray::engine::importers
