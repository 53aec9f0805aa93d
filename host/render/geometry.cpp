#include "render/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "core/parallel_for.hpp"
#include "render/mesh_records.hpp"
#include "render/node_coding.hpp"
#include "render/solid_records.hpp"

namespace eyeray {
namespace {

// Up to here testing everything is as fast as a tree.
constexpr size_t few_primitives = 24;
// A box that takes this part of the scene's own is met by nearly every ray that meets the scene. To test what
// is in it straight away is cheaper than steps that lead there, while such primitives are few.
constexpr double most_of_scene = 0.5;
constexpr size_t most_beside_tree = 4;

float below(double x) {
  const float rounded = float(x);
  return double(rounded) <= x ? rounded : std::nextafter(rounded, -HUGE_VALF);
}
float above(double x) {
  return -below(-x);
}

// Around what a shape's record says, whose coordinates are rounded.
accel::Box to_box(const Bounds& bounds, const Vec3& eye) {
  accel::Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = bounds.min[axis] - eye[axis];
    const double upper = bounds.max[axis] - eye[axis];
    const double room = 0x1p-22 * std::max(std::fabs(lower), std::fabs(upper));
    box.lower[axis] = below(lower - room);
    box.upper[axis] = above(upper + room);
  }
  return box;
}

// The boxes of what is below and above a plane, of a triangle.
std::pair<accel::Box, accel::Box> cut_triangle(const shader::Primitive& triangle, int axis, float position) {
  const glm::vec3 corners[] = {glm::vec3(triangle.a), glm::vec3(triangle.b), glm::vec3(triangle.c)};
  accel::Box low, high;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 from(corners[i]);
    const glm::dvec3 to(corners[(i + 1) % 3]);
    const double plane = double(position);
    if (from[axis] <= plane) low.include(corners[i]);
    if (from[axis] >= plane) high.include(corners[i]);
    if ((from[axis] < plane && to[axis] > plane) || (from[axis] > plane && to[axis] < plane)) {
      // Both boxes take the crossing, rounded to either side.
      const glm::dvec3 crossing = from + (to - from) * ((plane - from[axis]) / (to[axis] - from[axis]));
      glm::vec3 lower, upper;
      for (int k = 0; k < 3; ++k) {
        lower[k] = k == axis ? position : std::nextafter(below(crossing[k]), -HUGE_VALF);
        upper[k] = k == axis ? position : std::nextafter(above(crossing[k]), HUGE_VALF);
      }
      for (accel::Box* box : {&low, &high}) {
        box->include(lower);
        box->include(upper);
      }
    }
  }
  return {low, high};
}

class GeometryPacker {
 public:
  GeometryPacker(const Scene& scene, const PackOptions& options, Packer& packer)
      : scene_(scene), options_(options), packer_(packer), packed_(packer.scene) {}

  void run() {
    check_counts();
    count_uses();
    add_shapes();
    add_meshes();
    use_tree_ = options_.acceleration == Acceleration::tree ||
                (options_.acceleration == Acceleration::automatic &&
                 (world_size() + packed_.solid_leaves > few_primitives || !scene_.instances.empty()));
    if (world_size() > few_primitives && packed_.instances.empty()) unbind_largest();
    packed_.has_tree = use_tree_ && has_bounded(2);
    if (packed_.has_tree) build_trees();
    lay_out_world();
    lay_out_meshes();
    packed_.stack_size = packed_.has_tree ? uint32_t(world_tree_.depth + 2 + deepest_mesh()) : 1;
  }

 private:
  // Triangles that are the world's own, from its item `first` on.
  struct Baked {
    uint32_t first;
    MeshRecords records;
  };
  struct MeshTree {
    Vec3 origin;  // of its space, in the mesh's
    MeshRecords records;
    std::vector<accel::Box> boxes;  // of its triangles
    accel::Box box;                 // around all
    accel::Tree tree;
  };

  void check_counts() const {
    if (scene_.primitive_count() > uint64_t{std::numeric_limits<int32_t>::max()})
      throw Error(ExitCode::bad_input, "the scene has {} primitives; ids go up to {}",
                  scene_.primitive_count(), std::numeric_limits<int32_t>::max());
    if (scene_.materials.size() > MOST_MATERIALS)
      throw Error(ExitCode::bad_input, "the scene has {} materials; at most {} are possible",
                  scene_.materials.size(), MOST_MATERIALS);
  }

  void count_uses() {
    uses_.resize(scene_.meshes.size());
    for (const Instance& instance : scene_.instances) ++uses_[size_t(instance.mesh)];
  }

  void add_shapes() {
    for (size_t id = 0; id < scene_.shapes.size(); ++id) {
      const Shape& shape = *scene_.shapes[id];
      packer_.pieces.clear();
      const size_t first = packed_.primitives.size();
      shape.pack(packer_);
      const size_t pieces = std::max(packer_.pieces.size(), size_t{1});
      CHECK_EQ(packed_.primitives.size() - first, pieces);
      for (size_t i = first; i < packed_.primitives.size(); ++i) {
        shader::Primitive& record = packed_.primitives[i];
        record.head.x = uint32_t(id);
        if (kind_of(record) == shader::KIND_solid) finish_solid(record, packed_);
        record.head.z = use_material(kind_of(record), material_of(record), shape.counts_crossings());
        const Bounds bounds = packer_.pieces.empty() ? shape.bounds() : packer_.pieces[i - first];
        boxes_.push_back(kind_of(record) == shader::KIND_triangle ? triangle_box(record)
                                                                  : to_box(bounds, scene_.camera.eye));
      }
    }
    shapes_ = std::move(packed_.primitives);
    packed_.primitives.clear();
  }

  void add_meshes() {
    auto id = uint32_t(scene_.shapes.size());
    std::vector<int> tree_of(scene_.meshes.size(), -1);
    for (const Instance& instance : scene_.instances) {
      const Mesh& mesh = scene_.meshes[size_t(instance.mesh)];
      const Affine map(instance.transform);
      if (mesh.triangles.empty()) continue;
      packed_.vertex_colors = packed_.vertex_colors || !mesh.colors.empty();
      if (uses_[size_t(instance.mesh)] == 1 || mesh.triangles.size() == 1) {
        baked_.push_back(
            {uint32_t(boxes_.size()),
             {mesh, map, scene_.camera.eye, instance.material,
              use_material(shader::KIND_triangle, uint32_t(instance.material), true), id, packed_.vertices}});
        append_boxes(baked_.back().records, boxes_);
      } else {
        int& tree = tree_of[size_t(instance.mesh)];
        if (tree < 0) {
          tree = int(mesh_trees_.size());
          const Bounds extent = bounds(mesh);
          const Vec3 centre = (extent.min + extent.max) * 0.5;
          MeshTree& added = mesh_trees_.emplace_back(
              MeshTree{centre, {mesh, Affine(Mat4(1.0)), centre, 0, 0, 0, packed_.vertices}, {}, {}, {}});
          append_boxes(added.records, added.boxes);
          for (const accel::Box& box : added.boxes) added.box.include(box);
        }
        add_instance(instance, map, uint32_t(tree), id);
      }
      id += uint32_t(mesh.triangles.size());
    }
  }

  static void append_boxes(const MeshRecords& records, std::vector<accel::Box>& boxes) {
    const size_t first = boxes.size();
    boxes.resize(first + records.size());
    parallel_for(0, int(records.size()), [&](int i) { boxes[first + size_t(i)] = records.box(uint32_t(i)); });
  }

  void add_instance(const Instance& instance, const Affine& map, uint32_t tree, uint32_t first_id) {
    // World is relative to the eye, and the mesh to the centre of its bounds.
    const Vec3& eye = scene_.camera.eye;
    const Vec3& centre = mesh_trees_[tree].origin;
    const Mat3 inverse = glm::inverse(map.linear);
    const Vec3 to_world_offset = map.point(centre) - eye;
    const Vec3 to_mesh_offset = inverse * -to_world_offset;
    shader::Instance record{};
    record.head = {tree + 1, first_id, uint32_t(instance.material),
                   use_material(shader::KIND_triangle, uint32_t(instance.material), true)};
    for (int row = 0; row < 3; ++row) {
      record.to_mesh[row] = to_vec4({inverse[0][row], inverse[1][row], inverse[2][row]}, to_mesh_offset[row]);
      record.to_world[row] =
          to_vec4({map.linear[0][row], map.linear[1][row], map.linear[2][row]}, to_world_offset[row]);
    }
    packed_.instances.push_back(record);
  }

  // Takes note that shapes of a kind are made of a material. Returns what a shadow ray loses to each: a shape
  // weakens it once, a mesh or patch half at each crossing, for a closed body is left as it was entered.
  uint32_t use_material(uint32_t kind, uint32_t material, bool at_each_crossing) {
    const shader::uvec4& head = packed_.materials[material].head;
    packed_.uses.emplace(kind, material);
    translucent_ = translucent_ || head.w < SHADOW_OPAQUE;
    return at_each_crossing && head.w < SHADOW_OPAQUE ? head.w / 2 : head.w;
  }

  // The world's own items: shapes, then the triangles of baked meshes.
  uint32_t world_size() const {
    return baked_.empty() ? uint32_t(shapes_.size()) : baked_.back().first + baked_.back().records.size();
  }
  uint32_t world_kind(uint32_t item) const {
    return item < shapes_.size() ? kind_of(shapes_[item]) : uint32_t{shader::KIND_triangle};
  }
  shader::Primitive world_record(uint32_t item) const {
    if (item < shapes_.size()) return shapes_[item];
    const auto after = std::upper_bound(baked_.begin(), baked_.end(), item,
                                        [](uint32_t i, const Baked& mesh) { return i < mesh.first; });
    const Baked& mesh = *std::prev(after);
    return mesh.records.record(item - mesh.first);
  }

  // A floor under many small shapes, say: it stays beside the tree, whose boxes are then coded more finely,
  // and whose leaves may be of one kind.
  void unbind_largest() {
    accel::Box all;
    for (const accel::Box& box : boxes_)
      if (box.is_finite()) all.include(box);
    std::vector<size_t> large;
    for (size_t i = 0; i < boxes_.size() && large.size() <= most_beside_tree; ++i)
      if (boxes_[i].is_finite() && boxes_[i].area() >= most_of_scene * all.area()) large.push_back(i);
    if (large.size() > most_beside_tree) return;
    for (const size_t i : large)
      boxes_[i] = {glm::vec3(-std::numeric_limits<float>::infinity()),
                   glm::vec3(std::numeric_limits<float>::infinity())};
  }

  bool has_bounded(size_t least) const {
    return packed_.instances.size() +
               size_t(std::count_if(boxes_.begin(), boxes_.end(),
                                    [](const accel::Box& box) { return box.is_finite(); })) >=
           least;
  }

  // `record(item)` as for world_record.
  template <typename Record>
  accel::TreeOptions tree_options(uint32_t items, const Record& record) const {
    accel::TreeOptions options;
    options.first_lone = items;
    // An item that stands in two leaves would weaken a shadow ray twice.
    options.split = options_.split && !translucent_;
    options.cut = [items, record](uint32_t item, int axis, float position) {
      if (item < items) {
        const shader::Primitive primitive = record(item);
        if (kind_of(primitive) == shader::KIND_triangle) return cut_triangle(primitive, axis, position);
      }
      const accel::Box everything{glm::vec3(-HUGE_VALF), glm::vec3(HUGE_VALF)};
      return std::pair(everything, everything);
    };
    return options;
  }

  void build_trees() {
    for (MeshTree& mesh : mesh_trees_) {
      mesh.tree = build_tree(mesh.boxes, tree_options(mesh.records.size(), [&](uint32_t item) {
                               return mesh.records.record(item);
                             }));
      mesh.boxes = {};
    }
    const uint32_t first_instance = world_size();
    for (const shader::Instance& instance : packed_.instances) boxes_.push_back(instance_box(instance));
    world_tree_ = build_tree(
        boxes_, tree_options(first_instance, [this](uint32_t item) { return world_record(item); }));
    packed_.quantised_nodes = quantising_is_harmless(world_tree_) &&
                              std::all_of(mesh_trees_.begin(), mesh_trees_.end(), [](const MeshTree& mesh) {
                                return quantising_is_harmless(mesh.tree);
                              });
  }

  // Around all corners of the mesh's box, with room for their rounding.
  accel::Box instance_box(const shader::Instance& instance) const {
    const accel::Box& mesh = mesh_trees_[instance.head.x - 1].box;
    accel::Box box;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p(corner & 1 ? mesh.upper.x : mesh.lower.x, corner & 2 ? mesh.upper.y : mesh.lower.y,
                         corner & 4 ? mesh.upper.z : mesh.lower.z);
      for (int row = 0; row < 3; ++row) {
        const glm::dvec4 map(instance.to_world[row]);
        const double x = glm::dot(glm::dvec3(map), p) + map.w;
        const double room = 1e-6 * (glm::dot(glm::abs(glm::dvec3(map)), glm::abs(p)) + std::fabs(map.w));
        box.lower[row] = std::min(box.lower[row], below(x - room));
        box.upper[row] = std::max(box.upper[row], above(x + room));
      }
    }
    return box;
  }

  // A ray is mapped into an instance with errors that grow with its coordinates, wherever the tree's own
  // origin is. Seen from the world they are |linear| · |inverse| times as large: 3 at most where axes are
  // stretched and then turned, more under shears. So they are in a shape's own space, but from its centre.
  void make_room_for_maps(shader::Tree& tree) const {
    constexpr float harmless = 3;  // what the boxes have room for without this
    if (packed_.instances.empty() && packed_.map_growth <= harmless) return;
    float growth = packed_.map_growth;
    for (const shader::Instance& instance : packed_.instances)
      for (const shader::vec4& row : instance.to_world) {
        float sum = 0;
        for (int column = 0; column < 3; ++column)
          for (int k = 0; k < 3; ++k) sum += std::fabs(row[k] * instance.to_mesh[k][column]);
        growth = std::max(growth, sum);
      }
    // Twice: for the way into the mesh, and for what a triangle there allows for rounding.
    const float slack = tree.extent.w * 2 * growth;
    tree.extent = shader::vec4(glm::vec3(tree.extent) + glm::abs(glm::vec3(tree.origin)), slack);
  }

  // Slots of the world: by kind, what is in no tree, then what is, as its leaves hold it.
  void lay_out_world() {
    std::vector<std::vector<uint32_t>> loose(shader::SHAPE_KINDS);
    const uint32_t size = world_size();
    for (uint32_t item = 0; item < size; ++item) {
      if (!packed_.has_tree || !boxes_[item].is_finite())
        loose[world_kind(item)].push_back(item);
      else
        packed_.tree_kinds.insert(world_kind(item));
    }
    if (!mesh_trees_.empty()) packed_.tree_kinds.insert(shader::KIND_triangle);
    boxes_ = {};
    const auto record = [this](uint32_t item) { return world_record(item); };
    for (const auto& items : loose) {
      append_records(items, record);
      packed_.loose_ends.push_back(uint32_t(packed_.primitives.size()));
    }
    lay_out(world_tree_, size, record);
    if (packed_.has_tree) make_room_for_maps(packed_.trees.back());
  }

  void lay_out_meshes() {
    for (MeshTree& mesh : mesh_trees_) {
      const auto record = [&](uint32_t item) { return mesh.records.record(item); };
      if (!packed_.has_tree) {
        mesh.tree.order.resize(mesh.records.size());
        std::iota(mesh.tree.order.begin(), mesh.tree.order.end(), 0u);
      }
      lay_out(mesh.tree, mesh.records.size(), record);
      packed_.trees.back().reach =
          shader::vec4(glm::max(glm::abs(mesh.box.lower), glm::abs(mesh.box.upper)), 0.0f);
    }
    if (packed_.primitives.size() > MOST_SLOTS)
      throw Error(ExitCode::bad_input, "the scene has {} primitives in memory; at most {} can be addressed",
                  packed_.primitives.size(), MOST_SLOTS);
  }

  template <typename Record>
  void lay_out(accel::Tree& tree, uint32_t first_instance, const Record& record) {
    const auto first_slot = uint32_t(packed_.primitives.size());
    append_records(tree.order, record);
    if (packed_.has_tree) {
      add_tree(tree, first_slot, first_instance, packed_);
    } else {
      packed_.trees.emplace_back();
      packed_.trees.back().head = {0u, first_slot, uint32_t(packed_.primitives.size()), 0u};
    }
    tree.nodes = {};
    tree.order = {};
  }

  template <typename Record>
  void append_records(std::span<const uint32_t> items, const Record& record) {
    const size_t first = packed_.primitives.size();
    packed_.primitives.resize(first + items.size());
    parallel_for(0, int(items.size()),
                 [&](int i) { packed_.primitives[first + size_t(i)] = record(items[size_t(i)]); });
  }

  int deepest_mesh() const {
    int depth = 0;
    for (const MeshTree& mesh : mesh_trees_) depth = std::max(depth, mesh.tree.depth);
    return depth;
  }

  const Scene& scene_;
  const PackOptions& options_;
  Packer& packer_;
  PackedScene& packed_;
  std::vector<uint32_t> uses_;             // by mesh
  std::vector<shader::Primitive> shapes_;  // by id; several of one id where a shape consists of pieces
  std::vector<Baked> baked_;
  std::vector<accel::Box>
      boxes_;  // of the world's items, then of the instances; one without bounds is in no tree
  std::vector<MeshTree> mesh_trees_;
  accel::Tree world_tree_;
  bool use_tree_ = false;
  bool translucent_ = false;
};

}  // namespace

void pack_geometry(const Scene& scene, const PackOptions& options, Packer& packer) {
  GeometryPacker(scene, options, packer).run();
}

}  // namespace eyeray
