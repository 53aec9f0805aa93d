#include "render/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "core/parallel_for.hpp"
#include "render/mesh_records.hpp"
#include "render/node_coding.hpp"

namespace eyeray {
namespace {

// Up to here testing everything is as fast as a tree.
constexpr size_t few_primitives = 24;
constexpr uint32_t instance_kind = shader::SHAPE_KINDS;
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

accel::Box triangle_box(const shader::Primitive& triangle) {
  accel::Box box;
  for (const shader::vec4& corner : {triangle.a, triangle.b, triangle.c}) box.include(glm::vec3(corner));
  return box;
}

bool is_bounded(const accel::Box& box) {
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(box.lower[axis]) || !std::isfinite(box.upper[axis])) return false;
  return true;
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
    fill_densities();
    use_tree_ = options_.acceleration == Acceleration::tree ||
                (options_.acceleration == Acceleration::automatic &&
                 (world_.size() > few_primitives || !scene_.instances.empty()));
    if (world_.size() > few_primitives && packed_.instances.empty()) unbind_largest();
    packed_.has_tree = use_tree_ && has_bounded(2);
    if (packed_.has_tree) build_trees();
    lay_out_world();
    lay_out_meshes();
    packed_.stack_size = packed_.has_tree ? uint32_t(world_tree_.depth + 2 + deepest_mesh()) : 1;
  }

 private:
  struct MeshTree {
    int mesh;
    Vec3 origin;  // of its space, in the mesh's
    std::vector<shader::Primitive> primitives;
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
    for (const auto& shape : scene_.shapes) {
      shape->pack(packer_);
      const shader::Primitive& record = packed_.primitives.back();
      boxes_.push_back(kind_of(record) == shader::KIND_triangle ? triangle_box(record)
                                                                : to_box(shape->bounds(), scene_.camera.eye));
    }
    world_ = std::move(packed_.primitives);
    packed_.primitives.clear();
    CHECK_EQ(world_.size(), scene_.shapes.size());
    for (size_t i = 0; i < world_.size(); ++i) world_[i].head.x = uint32_t(i);
  }

  void add_meshes() {
    auto id = uint32_t(scene_.shapes.size());
    std::vector<int> tree_of(scene_.meshes.size(), -1);
    for (const Instance& instance : scene_.instances) {
      const Mesh& mesh = scene_.meshes[size_t(instance.mesh)];
      const Affine map(instance.transform);
      if (mesh.triangles.empty()) continue;
      if (uses_[size_t(instance.mesh)] == 1 || mesh.triangles.size() == 1) {
        add_to_world(mesh_records(mesh, map, scene_.camera.eye, instance.material, id, packed_.vertices));
      } else {
        int& tree = tree_of[size_t(instance.mesh)];
        if (tree < 0) {
          tree = int(mesh_trees_.size());
          const Bounds extent = bounds(mesh);
          const Vec3 centre = (extent.min + extent.max) * 0.5;
          mesh_trees_.push_back({instance.mesh,
                                 centre,
                                 mesh_records(mesh, Affine(Mat4(1.0)), centre, 0, 0, packed_.vertices),
                                 {}});
        }
        add_instance(instance, map, uint32_t(tree), id);
      }
      id += uint32_t(mesh.triangles.size());
    }
  }

  void add_to_world(std::vector<shader::Primitive> triangles) {
    const size_t first = boxes_.size();
    boxes_.resize(first + triangles.size());
    parallel_for(0, int(triangles.size()),
                 [&](int i) { boxes_[first + size_t(i)] = triangle_box(triangles[size_t(i)]); });
    if (world_.empty())
      world_ = std::move(triangles);
    else
      world_.insert(world_.end(), triangles.begin(), triangles.end());
  }

  void add_instance(const Instance& instance, const Affine& map, uint32_t tree, uint32_t first_id) {
    // World is relative to the eye, and the mesh to the centre of its bounds.
    const Vec3& eye = scene_.camera.eye;
    const Vec3& centre = mesh_trees_[tree].origin;
    const Mat3 inverse = glm::inverse(map.linear);
    const Vec3 to_world_offset = map.point(centre) - eye;
    const Vec3 to_mesh_offset = inverse * -to_world_offset;
    shader::Instance record{};
    record.head = {tree + 1, first_id, uint32_t(instance.material), 0u};
    for (int row = 0; row < 3; ++row) {
      record.to_mesh[row] = to_vec4({inverse[0][row], inverse[1][row], inverse[2][row]}, to_mesh_offset[row]);
      record.to_world[row] =
          to_vec4({map.linear[0][row], map.linear[1][row], map.linear[2][row]}, to_world_offset[row]);
    }
    packed_.instances.push_back(record);
  }

  // What a shadow ray loses to each: a shape weakens it once, a mesh half at each of its triangles, for a
  // closed body is left as it was entered.
  void fill_densities() {
    const auto density = [&](uint32_t material, bool of_mesh) {
      const uint32_t whole = packed_.materials[material].head.w;
      return of_mesh && whole < SHADOW_OPAQUE ? whole / 2 : whole;
    };
    for (shader::Primitive& primitive : world_) {
      primitive.head.z = density(material_of(primitive), primitive.head.x >= scene_.shapes.size());
      translucent_ = translucent_ || primitive.head.z < SHADOW_OPAQUE;
    }
    for (shader::Instance& instance : packed_.instances) {
      instance.head.w = density(instance.head.z, true);
      translucent_ = translucent_ || instance.head.w < SHADOW_OPAQUE;
    }
  }

  // A floor under many small shapes, say: it stays beside the tree, whose boxes are then coded more finely,
  // and whose leaves may be of one kind.
  void unbind_largest() {
    accel::Box all;
    for (const accel::Box& box : boxes_)
      if (is_bounded(box)) all.include(box);
    std::vector<size_t> large;
    for (size_t i = 0; i < boxes_.size() && large.size() <= most_beside_tree; ++i)
      if (is_bounded(boxes_[i]) && boxes_[i].area() >= most_of_scene * all.area()) large.push_back(i);
    if (large.size() > most_beside_tree) return;
    for (const size_t i : large)
      boxes_[i] = {glm::vec3(-std::numeric_limits<float>::infinity()),
                   glm::vec3(std::numeric_limits<float>::infinity())};
  }

  bool has_bounded(size_t least) const {
    return packed_.instances.size() + size_t(std::count_if(boxes_.begin(), boxes_.end(), is_bounded)) >=
           least;
  }

  accel::TreeOptions tree_options(std::span<const shader::Primitive> primitives) const {
    accel::TreeOptions options;
    options.lone_kind = instance_kind;
    // An item that stands in two leaves would weaken a shadow ray twice.
    options.split = options_.split && !translucent_;
    options.cut = [primitives](uint32_t item, int axis, float position) {
      if (item < primitives.size() && kind_of(primitives[item]) == shader::KIND_triangle)
        return cut_triangle(primitives[item], axis, position);
      const accel::Box everything{glm::vec3(-HUGE_VALF), glm::vec3(HUGE_VALF)};
      return std::pair(everything, everything);
    };
    return options;
  }

  void build_trees() {
    for (MeshTree& mesh : mesh_trees_) {
      std::vector<accel::Box> boxes(mesh.primitives.size());
      std::transform(mesh.primitives.begin(), mesh.primitives.end(), boxes.begin(), triangle_box);
      mesh.tree = build_tree(boxes, std::vector<uint8_t>(boxes.size(), 0), 1, tree_options(mesh.primitives));
    }

    // The world: bounded primitives, and instances as items of a kind of their own.
    std::vector<accel::Box> boxes;
    std::vector<uint8_t> kinds;
    std::vector<shader::Primitive> items;
    boxes.reserve(world_.size() + packed_.instances.size());
    kinds.reserve(boxes.capacity());
    in_tree_.reserve(world_.size());
    for (size_t i = 0; i < world_.size(); ++i) {
      if (!is_bounded(boxes_[i])) continue;
      in_tree_.push_back(uint32_t(i));
      boxes.push_back(boxes_[i]);
      kinds.push_back(uint8_t(kind_of(world_[i])));
    }
    if (options_.split)
      for (const uint32_t i : in_tree_) items.push_back(world_[i]);
    for (const shader::Instance& instance : packed_.instances) {
      boxes.push_back(instance_box(instance));
      kinds.push_back(uint8_t(instance_kind));
    }
    world_tree_ = build_tree(boxes, kinds, instance_kind + 1, tree_options(items));
    // An instance is known by its index, not by its place among the items.
    for (uint32_t i = world_tree_.kind_ends[instance_kind - 1]; i < world_tree_.kind_ends[instance_kind]; ++i)
      world_tree_.order[i] -= uint32_t(in_tree_.size());

    packed_.quantised_nodes = quantising_is_harmless(world_tree_) &&
                              std::all_of(mesh_trees_.begin(), mesh_trees_.end(), [](const MeshTree& mesh) {
                                return quantising_is_harmless(mesh.tree);
                              });
  }

  // Around all corners of the mesh's box, with room for their rounding.
  accel::Box instance_box(const shader::Instance& instance) const {
    const accel::Box& mesh = mesh_trees_[instance.head.x - 1].tree.box;
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
  // stretched and then turned, more under shears.
  void make_room_for_instances(shader::Tree& tree) const {
    if (packed_.instances.empty()) return;
    float growth = 1;
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
    for (uint32_t i = 0; i < world_.size(); ++i)
      if (!packed_.has_tree || !is_bounded(boxes_[i])) loose[kind_of(world_[i])].push_back(i);
    std::vector<uint32_t> first_slots(shader::SHAPE_KINDS + 1, 0);
    packed_.primitives.reserve(world_.size());
    for (uint32_t kind = 0; kind < shader::SHAPE_KINDS; ++kind) {
      packed_.kind_first.push_back(uint32_t(packed_.primitives.size()));
      for (const uint32_t i : loose[kind]) packed_.primitives.push_back(world_[i]);
      packed_.kind_loose.push_back(uint32_t(packed_.primitives.size()));
      if (!packed_.has_tree) continue;
      const uint32_t begin = kind == 0 ? 0 : world_tree_.kind_ends[kind - 1];
      first_slots[kind] = uint32_t(packed_.primitives.size()) - begin;
      for (uint32_t i = begin; i < world_tree_.kind_ends[kind]; ++i)
        packed_.primitives.push_back(world_[in_tree_[world_tree_.order[i]]]);
    }
    packed_.kind_first.push_back(uint32_t(packed_.primitives.size()));
    world_ = {};
    if (packed_.has_tree) {
      add_tree(world_tree_, first_slots, instance_kind, packed_);
      make_room_for_instances(packed_.trees.back());
    } else
      packed_.trees.emplace_back();
  }

  void lay_out_meshes() {
    for (MeshTree& mesh : mesh_trees_) {
      const auto first = uint32_t(packed_.primitives.size());
      if (packed_.has_tree) {
        for (const uint32_t i : mesh.tree.order) packed_.primitives.push_back(mesh.primitives[i]);
        const uint32_t first_slots[] = {first};
        add_tree(mesh.tree, first_slots, instance_kind, packed_);
      } else {
        packed_.primitives.insert(packed_.primitives.end(), mesh.primitives.begin(), mesh.primitives.end());
        packed_.trees.emplace_back();
      }
      packed_.trees.back().head.y = first;
      packed_.trees.back().head.z = uint32_t(packed_.primitives.size());
      packed_.trees.back().reach = shader::vec4(reach(mesh.primitives), 0.0f);
      mesh.primitives = {};
    }
    if (packed_.primitives.size() > MOST_SLOTS)
      throw Error(ExitCode::bad_input, "the scene has {} primitives in memory; at most {} can be addressed",
                  packed_.primitives.size(), MOST_SLOTS);
  }

  int deepest_mesh() const {
    int depth = 0;
    for (const MeshTree& mesh : mesh_trees_) depth = std::max(depth, mesh.tree.depth);
    return depth;
  }

  // The largest magnitudes of the coordinates.
  static glm::vec3 reach(std::span<const shader::Primitive> triangles) {
    accel::Box box;
    for (const shader::Primitive& triangle : triangles) box.include(triangle_box(triangle));
    return glm::max(glm::abs(box.lower), glm::abs(box.upper));
  }

  const Scene& scene_;
  const PackOptions& options_;
  Packer& packer_;
  PackedScene& packed_;
  std::vector<uint32_t> uses_;            // by mesh
  std::vector<shader::Primitive> world_;  // by id, as far as they belong to the world
  std::vector<accel::Box> boxes_;         // of each of them; without bounds, it is in no tree
  std::vector<uint32_t> in_tree_;         // items of the world's tree: indices in world_
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
