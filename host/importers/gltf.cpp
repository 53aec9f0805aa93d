// Reads glTF 2.0, .gltf and .glb: the nodes of its scene become instances, lights and a camera. nlohmann/json
// reads the JSON, and this importer checks each value. tinygltf 2.7 is not used: it reads beyond the end of a
// .glb whose last chunk is too long, throws at an empty buffer, and does not check a bufferView's range.
// Source: Khronos Group: glTF 2.0 Specification (2.0.1); KHR_lights_punctual.
#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "host/importers/cloud_builder.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/gltf_animation.hpp"
#include "host/importers/gltf_camera.hpp"
#include "host/importers/gltf_instancing.hpp"
#include "host/importers/gltf_lights.hpp"
#include "host/importers/gltf_links.hpp"
#include "host/importers/gltf_materials.hpp"
#include "host/importers/gltf_meshes.hpp"
#include "host/importers/gltf_nodes.hpp"
#include "host/importers/gltf_properties.hpp"
#include "host/importers/line_builder.hpp"
#include "host/importers/malformed.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::importers {

namespace {

constexpr size_t most_extensions_named = 16;

std::set<std::string> as_set(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

// Limit on the points that instances add to those of the file.
constexpr size_t most_copied_points = size_t{1} << 24;

// Limit on a file's instances: a few meshes and nodes may make very many.
constexpr size_t most_instances = size_t{1} << 20;

class GltfReader {
 public:
  explicit GltfReader(MeshFile& file)
      : container_(open_gltf(file.bytes, file.name)),
        json_(parse_gltf_json(container_.json, file.name)),
        document_(json_, "", file.name),
        breaches_(document_),
        textures_(file.assets, *file.pixels, scene_.warnings),
        buffers_(document_, container_, file.assets, breaches_),
        materials_(document_, buffers_, textures_, left_out_, breaches_),
        meshes_(document_, buffers_, materials_, left_out_, breaches_, file.name,
                file.options.smooth.value_or(0), file.options.line_width.has_value()),
        lines_(file.name, file.options.line_width),
        name_(file.name),
        options_(file.options) {}

  ImportedScene read() {
    check_extensions();
    if (const auto asset = document_.object("asset"); asset && asset->text("version") != "2.0")
      breaches_.add("versions of glTF above 2.0, read as 2.0", "asset.version");
    check_properties(json_, breaches_);
    check_links(json_, breaches_);
    for (const std::string& breach : container_.breaches) breaches_.add(breach, "the file");
    for (size_t i = 0; i < document_.size("materials"); ++i)
      scene_.materials.push_back(materials_.material(i));
    scene_.animations = document_.names("animations");
    scene_.scenes = document_.names("scenes");
    if (const auto animation = find_animation(scene_.animations, options_.playing)) {
      motion_ = motion_at(document_, *animation, options_.playing, buffers_, left_out_, breaches_);
      scene_.played = motion_.played;
    }
    if (const auto variants = document_.extension("KHR_materials_variants")) {
      scene_.variants = variants->names("variants");
      if (options_.variant) meshes_.show_variant(find_named(scene_.variants, *options_.variant));
    }
    read_nodes();
    lines_.report(scene_.warnings);
    left_out_.report(scene_.warnings);
    if (flattened_ > 0) {
      scene_.warnings.push_back(fmt::format("{} whose transforms flatten everything {} left out",
                                            flattened_ == 1 ? "a node" : fmt::format("{} nodes", flattened_),
                                            flattened_ == 1 ? "was" : "were"));
    }
    breaches_.report(scene_.warnings);
    scene_.meshes = meshes_.take(scene_.warnings);
    return std::move(scene_);
  }

 private:
  struct Visit {
    size_t node;
    Mat4 parent;
    bool hidden;  // true if the node above it is hidden
  };

  void check_extensions();
  void read_nodes();
  void read_node(size_t index);
  void add_camera(const GltfObject& node, const GltfObject& source, const Mat4& world);
  void read_mesh(size_t index, size_t mesh, const Mat4& world);
  void add_loose(const GltfObject& node, const GltfMeshes::Part& part, std::span<const Mat4> transforms,
                 bool posed);
  int loose_material(const GltfMeshes::Part& part);
  int material_of(const GltfMeshes::Part& part);
  Mat4 transform(size_t index);
  bool is_flat(const Mat4& world);
  const std::vector<double>* moved(size_t node, const char* key) const;
  void check_parents();

  GltfContainer container_;
  nlohmann::json json_;
  GltfObject document_;
  GltfBreaches breaches_;
  ImportedScene scene_;
  GltfLeftOut left_out_;
  TextureFiles textures_;
  GltfBuffers buffers_;
  GltfMaterials materials_;
  GltfMeshes meshes_;
  LineBuilder lines_;
  std::string name_;
  ImportOptions options_;
  GltfMotion motion_;
  std::vector<std::optional<Mat4>> worlds_;  // from each node to the world, if the node is in the scene
  std::vector<bool> hidden_;                 // one a node
  std::vector<std::optional<std::vector<Mat4>>> joints_;  // one list a skin, once the skin is used
  size_t flattened_ = 0;
  size_t copied_points_ = 0;  // all that were shown before, by another node or instance
  std::set<const GltfMeshes::Loose*> shown_points_;
  std::array<int, 2> plain_ = {-1, -1};  // indices of the plain materials, without colours and with them
};

void GltfReader::check_extensions() {
  const std::set<std::string> required = as_set(document_.texts("extensionsRequired"));
  const std::set<std::string> declared = as_set(document_.texts("extensionsUsed"));
  std::set<std::string> names = extensions_of_objects(json_);
  names.insert(required.begin(), required.end());
  for (const std::string& name : names) {
    if (!declared.contains(name))
      breaches_.add("extensions that extensionsUsed does not name", printable(name));
  }
  names.insert(declared.begin(), declared.end());
  std::string needed;
  size_t unknown = 0;
  for (const std::string& name : names) {
    if (is_known_extension(name)) continue;
    if (++unknown > most_extensions_named) continue;
    if (required.contains(name)) {
      needed += (needed.empty() ? "" : ", ") + printable(name);
    } else {
      left_out_.add("the extension " + printable(name));
    }
  }
  if (unknown > most_extensions_named) left_out_.add("more extensions", unknown - most_extensions_named);
  if (!needed.empty())
    scene_.warnings.push_back("the picture is not as the file intends: it requires " + needed +
                              ", which eyeray does not support (extensionsRequired)");
}

// Visits the scene's nodes depth first, children in the order written.
void GltfReader::read_nodes() {
  const size_t nodes = document_.size("nodes");
  std::vector<bool> seen(nodes, false);
  std::vector<Visit> pending;
  const auto push = [&](const std::vector<size_t>& indices, const Mat4& parent, bool hidden) {
    for (size_t i = indices.size(); i-- > 0;) pending.push_back({indices[i], parent, hidden});
  };
  const auto chosen =
      options_.gltf_scene ? find_named(scene_.scenes, *options_.gltf_scene) : std::optional<size_t>();
  push(root_nodes(document_, chosen, scene_.scenes, scene_.warnings), Mat4(1.0), false);
  worlds_.resize(nodes);
  hidden_.resize(nodes);
  joints_.resize(document_.size("skins"));
  std::vector<size_t> order;
  while (!pending.empty()) {
    const Visit visit = pending.back();
    pending.pop_back();
    const GltfObject node = document_.element("nodes", visit.node);
    if (seen[visit.node])
      node.fail("is reached twice: a node can have one parent, and cannot be below itself");
    seen[visit.node] = true;
    const Mat4 world = visit.parent * transform(visit.node);
    worlds_[visit.node] = world;
    hidden_[visit.node] = visit.hidden || is_hidden(node);
    order.push_back(visit.node);
    push(node.indices("children", nodes), world, hidden_[visit.node]);
  }

  check_parents();

  // Read the nodes' contents only now: a skin needs the transforms of all its joints.
  for (const size_t index : order) read_node(index);
}

// Refuses a scene that shows a node without the nodes above it, if one of these would move the node. A breach
// if they move nothing.
void GltfReader::check_parents() {
  const std::vector<size_t> parents = parents_of_nodes(document_);
  std::vector<bool> still(parents.size(), false);
  for (size_t i = 0; i < parents.size(); ++i) {
    if (worlds_[i]) continue;
    for (const size_t below : document_.element("nodes", i).indices("children", parents.size())) {
      if (!worlds_[below]) continue;
      for (size_t above = i; above != no_parent && !still[above]; above = parents[above]) {
        if (transform(above) != Mat4(1.0)) {
          document_.element("nodes", above)
              .fail(fmt::format("moves nodes[{0}], which the scene shows without it: list nodes[{1}] in the "
                                "scene in place of nodes[{0}], or take nodes[{0}] out of the children",
                                below, above));
        }
        still[above] = true;
      }
      breaches_.add("nodes that the scene shows without the nodes above them, which move nothing",
                    document_.element("nodes", below).location());
    }
  }
}

// True if the map cannot be inverted, which is reported. Animations hide a node by scaling it to 0, which is
// not reported.
bool GltfReader::is_flat(const Mat4& world) {
  if (why_singular(world).empty()) return false;
  if (!scene_.played || Mat3(world) != Mat3(0.0)) ++flattened_;
  return true;
}

// The animated value of a key of a node; null if the animation does not change it.
const std::vector<double>* GltfReader::moved(size_t node, const char* key) const {
  const auto found = motion_.values.find({node, key});
  return found == motion_.values.end() ? nullptr : &found->second;
}

Mat4 GltfReader::transform(size_t index) {
  const GltfObject node = document_.element("nodes", index);
  if (node.has("matrix")) {
    if (node.has("translation") || node.has("rotation") || node.has("scale"))
      node.fail("has both a matrix and a translation, rotation or scale");
    const Mat4 matrix =
        glm::make_mat4(node.numbers("matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}).data());
    if (matrix[0].w != 0 || matrix[1].w != 0 || matrix[2].w != 0 || matrix[3].w != 1)
      node.fail("has a matrix that is not affine");
    if (shears(Mat3(matrix)))
      breaches_.add("matrices of nodes that shear, used unchanged", node.location() + ".matrix");
    return matrix;
  }
  const auto numbers = [&](const char* key, std::vector<double> fallback) {
    const std::vector<double>* const now = moved(index, key);
    return now ? *now : node.numbers(key, std::move(fallback));
  };
  const std::vector<double> t = numbers("translation", {0, 0, 0});
  const std::vector<double> q = numbers("rotation", {0, 0, 0, 1});
  const std::vector<double> s = numbers("scale", {1, 1, 1});
  return gltf_transform(node, "rotation", Vec3(t[0], t[1], t[2]), Vec4(q[0], q[1], q[2], q[3]),
                        Vec3(s[0], s[1], s[2]), breaches_);
}

void GltfReader::read_node(size_t index) {
  const GltfObject node = document_.element("nodes", index);
  const Mat4& world = *worlds_[index];
  const auto mesh = node.index("mesh", document_.size("meshes"));
  const auto camera = node.index("camera", document_.size("cameras"));
  const auto lights = document_.extension("KHR_lights_punctual");
  const auto light = node.extension("KHR_lights_punctual");
  if (!mesh && !camera && !light) return;
  if (mesh && !hidden_[index]) read_mesh(index, *mesh, world);
  if ((camera || light) && is_flat(world)) return;
  if (camera) add_camera(node, document_.element("cameras", *camera), world);
  if (light && !hidden_[index]) {
    const auto shown = light->index("light", lights ? lights->size("lights") : 0);
    if (!shown) light->fail("has no light");
    add_gltf_light(lights->element("lights", *shown), world, left_out_, breaches_, scene_);
  }
}

// Adds the camera of a node, under the node's name, or else its own. One that is faulty is in nobody's way
// until it is shown.
void GltfReader::add_camera(const GltfObject& node, const GltfObject& source, const Mat4& world) {
  ImportedCamera camera;
  try {
    camera = gltf_camera(source, world, breaches_);
  } catch (const InputError& faulty) {
    camera.fault = faulty.diagnostics().front();
    breaches_.add("cameras that are faulty, so they cannot be shown", source.location());
  }
  camera.name = node.text("name").empty() ? source.text("name") : node.text("name");
  scene_.cameras.push_back(std::move(camera));
}

// The material of a part. That of a part without one exists only in front, as glTF's default material.
int GltfReader::material_of(const GltfMeshes::Part& part) {
  if (part.material >= 0) return part.material;
  int& index = plain_[part.colored];
  if (index < 0) {
    index = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back(plain_material(part.colored));
    scene_.materials.back()->front_only = true;
  }
  return index;
}

// The material of points or lines. They overlap, so light cannot pass through them.
int GltfReader::loose_material(const GltfMeshes::Part& part) {
  if (part.material < 0) return -1;
  const Material& material = *scene_.materials[size_t(part.material)];
  const bool opaque =
      !material.medium() && !material.thin() && material.shadow_transmittance() == 0 && !material.mask;
  if (!opaque) left_out_.add("transparent materials of points and lines");
  return opaque ? part.material : -1;
}

// Adds the points or lines of a part under each transform. They are in world space, so that a node's scale
// does not change their size. `posed`: they are as only this node deforms them.
void GltfReader::add_loose(const GltfObject& node, const GltfMeshes::Part& part,
                           std::span<const Mat4> transforms, bool posed) {
  const GltfMeshes::Loose& loose = *part.loose;
  const int material = loose_material(part);
  if (!loose.lines.empty() && !loose.colors.empty()) left_out_.add("colours of lines");
  for (const Mat4& transform : transforms) {
    const auto place = [&](const Vec3& p) { return Vec3(transform * Vec4(p, 1)); };
    if (!loose.lines.empty()) {
      lines_.check_room(loose.lines.size());
      std::vector<LineSegment> segments;
      for (const auto& [from, to] : loose.lines)
        segments.push_back({place(loose.positions[from]), place(loose.positions[to])});
      lines_.add(std::move(segments), material, scene_);
      continue;
    }
    if (posed || !shown_points_.insert(&loose).second) copied_points_ += loose.positions.size();
    if (copied_points_ > most_copied_points)
      node.fail(fmt::format("is one of those that show points again; {} points may be added so",
                            most_copied_points));
    RawPoints raw{name_, {}, loose.colors};
    for (const Vec3& position : loose.positions) raw.positions.push_back(place(position));
    const Mat3 of_normals = glm::transpose(glm::inverse(Mat3(transform)));
    for (const Vec3& normal : loose.normals) raw.normals.push_back(of_normals * normal);
    if (auto cloud = build_cloud(std::move(raw), options_, scene_.warnings))
      scene_.clouds.push_back({std::move(cloud), material});
  }
}

void GltfReader::read_mesh(size_t index, size_t mesh, const Mat4& world) {
  const GltfObject node = document_.element("nodes", index);
  const std::vector<double>* const weights = moved(index, "weights");
  GltfPose pose{{}, weights ? *weights : node.numbers("weights")};
  if (const auto skin = node.index("skin", document_.size("skins"))) {
    auto& joints = joints_[*skin];
    if (!joints) joints = joint_matrices(document_, buffers_, *skin, worlds_);
    pose.joints = *joints;
    if (joints->empty()) left_out_.add("skins whose joints are not in the scene");
  }
  // A skinned mesh is in world space already, wherever its node is.
  const bool skinned = !pose.joints.empty();
  std::vector<Mat4> transforms = {skinned ? Mat4(1.0) : world};
  if (const auto instancing = node.extension("EXT_mesh_gpu_instancing")) {
    if (skinned) {
      left_out_.add("instances of meshes with a skin");
    } else {
      transforms = instance_transforms(*instancing, document_, buffers_, breaches_);
      for (Mat4& transform : transforms) transform = world * transform;
    }
  }
  if (!skinned) std::erase_if(transforms, [&](const Mat4& transform) { return is_flat(transform); });
  if (transforms.empty()) return;
  const bool posed = skinned || !pose.weights.empty();
  for (const GltfMeshes::Part& part : posed ? meshes_.posed_parts(mesh, pose) : meshes_.parts(mesh)) {
    if (transforms.size() > most_instances - scene_.instances.size())
      node.fail(
          fmt::format("is one of more than {} instances, the most that a file may have", most_instances));
    if (part.loose) {
      add_loose(node, part, transforms, posed);
      continue;
    }
    for (const Mat4& transform : transforms)
      scene_.instances.push_back({part.mesh, transform, material_of(part), {}});
  }
}

}  // namespace

ImportedScene import_gltf(MeshFile& file) {
  return GltfReader(file).read();
}

}  // namespace eyeray::engine::importers
