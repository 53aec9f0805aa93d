#include "host/pack/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "host/bvh/history.hpp"
#include "host/core/error.hpp"
#include "host/core/free_memory.hpp"
#include "host/core/parallel_for.hpp"
#include "host/pack/blas_records.hpp"
#include "host/pack/csg_records.hpp"
#include "host/pack/linear_list.hpp"
#include "host/pack/node_coding.hpp"
#include "host/pack/record_boxes.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/primitive_ids.hpp"

namespace eyeray::engine::pack {
namespace {

// Up to this many tests, testing everything is as fast as a BVH. Primitives count, and the iterations of
// their loops. Rays of paths take different ways through a BVH, so more tests pay for them, if a picture has
// enough samples to repay the compilation of the tests.
constexpr size_t few_tests = 24;
constexpr size_t few_tests_of_paths = 40;
constexpr int64_t least_samples_of_paths = 1 << 22;

size_t few_tests_of(const Scene& scene) {
  const bool paths =
      walks_at_random(scene.render.integrator) && scene.image.all_samples() >= least_samples_of_paths;
  return paths ? few_tests_of_paths : few_tests;
}

Vec3 middle(const Bounds& bounds) {
  return (bounds.min + bounds.max) * 0.5;
}

class GeometryPacker {
 public:
  GeometryPacker(const Scene& scene, const PackOptions& options, records::Packer& packer)
      : scene_(scene), options_(options), packer_(packer), packed_(packer.scene) {}

  void run() {
    check_counts();
    count_uses();
    world_ = shape_records(scene_.shapes, scene_.camera.eye, [this](size_t i) { return ids_.of_shape(i); });
    add_meshes();
    add_groups();
    packed_.most_linear = few_tests_of(scene_);
    use_bvh_ = options_.acceleration == Acceleration::bvh ||
               (options_.acceleration == Acceleration::automatic &&
                (world_.size() + packed_.shape_iterations > packed_.most_linear ||
                 !scene_.instances.empty() || !packed_.instances.empty()));
    if (world_.size() > packed_.most_linear && packed_.instances.empty()) unbind_few(world_);
    packed_.has_bvh = use_bvh_ && has_bounded(2);
    if (packed_.has_bvh) build_bvhs();
    lay_out_world();
    lay_out_spaces();
    packed_.stack_size = packed_.has_bvh ? uint32_t(world_bvh_.depth + 2 + deepest_space()) : 1;
  }

 private:
  // A mesh or a group that instances show, with its own BVH.
  struct Blas {
    Vec3 origin;  // the point that its records are relative to
    BlasRecords items;
    float map_growth = 1;  // PackedScene::map_growth for its shapes
    bvh::Box box = {};     // around all
    bvh::Bvh bvh = {};
  };

  void check_counts() const {
    if (ids_.count() > uint64_t{std::numeric_limits<int32_t>::max()})
      throw Error(ExitCode::bad_input, "the scene has {} primitives; ids go up to {}", ids_.count(),
                  std::numeric_limits<int32_t>::max());
    if (scene_.materials.size() > MOST_MATERIALS)
      throw Error(ExitCode::bad_input, "the scene has {} materials; at most {} are possible",
                  scene_.materials.size(), MOST_MATERIALS);
  }

  void count_uses() {
    uses_.resize(scene_.meshes.size());
    for (const Instance& instance : scene_.instances) ++uses_[size_t(instance.mesh)];
  }

  // The records of shapes, packed relative to `origin`. id(i) returns the index of the i-th shape.
  template <typename Id>
  BlasRecords shape_records(std::span<const std::unique_ptr<Shape>> shapes, const Vec3& origin,
                            const Id& id) {
    BlasRecords records;
    packer_.set_origin(origin);
    for (size_t i = 0; i < shapes.size(); ++i) {
      const Shape& shape = *shapes[i];
      shape.pack(packer_);
      // All pieces of a shape have its kind and its material.
      shader::Primitive& first = packed_.primitives.front();
      if (kind_of(first) == shader::KIND_csg) finish_csg(first, packed_);
      const uint32_t depth = use_material(kind_of(first), material_of(first), shape.counts_crossings());
      for (shader::Primitive& record : packed_.primitives) {
        record.id = uint32_t(id(i));
        record.optical_depth = depth;
      }
      if (packer_.pieces.empty()) {
        records.add_shape(first, kind_of(first) == shader::KIND_triangle ? triangle_box(first)
                                                                         : shape_box(shape.bounds(), origin));
      } else {
        records.add_shapes(packed_.primitives,
                           [&](size_t piece) { return shape_box(packer_.pieces[piece], origin); });
      }
      packed_.primitives.clear();
      free_memory(packer_.pieces);
    }
    packer_.set_origin(scene_.camera.eye);
    return records;
  }

  void note_attributes(const Mesh& mesh) {
    packed_.own_colors = packed_.own_colors || !mesh.colors.empty();
    packed_.second_uv = packed_.second_uv || !mesh.second_uv.empty();
  }

  // The triangles of an instance, under its transform and relative to `origin`.
  MeshRecords triangle_records(const Instance& instance, const Vec3& origin, uint32_t first_id) {
    const Mesh& mesh = scene_.meshes[size_t(instance.mesh)];
    note_attributes(mesh);
    return {mesh,
            Affine(instance.transform),
            origin,
            instance.material,
            use_material(shader::KIND_triangle, uint32_t(instance.material), true),
            first_id,
            packed_.bent_normals,
            packed_.vertices};
  }

  void add_meshes() {
    std::vector<int> space_of(scene_.meshes.size(), -1);
    for (size_t i = 0; i < scene_.instances.size(); ++i) {
      const Instance& instance = scene_.instances[i];
      const Mesh& mesh = scene_.meshes[size_t(instance.mesh)];
      const auto id = uint32_t(ids_.of_instance(i));
      if (mesh.triangles.empty()) continue;
      if (uses_[size_t(instance.mesh)] == 1 || mesh.triangles.size() == 1) {
        world_.add_mesh(triangle_records(instance, scene_.camera.eye, id));
        continue;
      }
      int& space = space_of[size_t(instance.mesh)];
      if (space < 0) {
        // Material and optical depth are each instance's own.
        Blas added{middle(bounds(mesh)), {}};
        added.items.add_mesh(
            {mesh, Affine(Mat4(1.0)), added.origin, 0, 0, 0, packed_.bent_normals, packed_.vertices});
        note_attributes(mesh);
        space = add_blas(std::move(added));
      }
      add_instance(instance.transform, uint32_t(space), id, uint32_t(instance.material),
                   use_material(shader::KIND_triangle, uint32_t(instance.material), true));
    }
  }

  void add_groups() {
    std::vector<int> space_of(scene_.groups.size(), -1);
    for (size_t i = 0; i < scene_.group_instances.size(); ++i) {
      const GroupInstance& instance = scene_.group_instances[i];
      int& space = space_of[size_t(instance.group)];
      if (count_primitives(scene_.groups[size_t(instance.group)], scene_.meshes) == 0) continue;
      if (space < 0) space = add_blas(group_blas(scene_.groups[size_t(instance.group)]));
      const auto [shape, triangle] = ids_.of_group(i);
      add_instance(instance.transform, uint32_t(space), uint32_t(shape), NONE, uint32_t(triangle));
    }
  }

  // The shapes and meshes of a group, relative to the centre of its bounds.
  Blas group_blas(const Group& group) {
    const Vec3 centre = middle(bounds(group, scene_.meshes));
    const float growth = std::exchange(packed_.map_growth, 1.0f);
    Blas space{centre, shape_records(group.shapes, centre, [](size_t id) { return id; })};
    space.map_growth = std::exchange(packed_.map_growth, std::max(growth, packed_.map_growth));
    uint32_t triangle = 0;
    for (const Instance& instance : group.instances) {
      space.items.add_mesh(triangle_records(instance, centre, triangle | ID_OF_TRIANGLE));
      triangle += uint32_t(scene_.meshes[size_t(instance.mesh)].triangles.size());
    }
    return space;
  }

  int add_blas(Blas space) {
    for (const bvh::Box& box : space.items.boxes) space.box.include(box);
    blases_.push_back(std::move(space));
    return int(blases_.size()) - 1;
  }

  // `material` and `depth_or_triangle`: as in shader::Instance.
  void add_instance(const Mat4& transform, uint32_t space, uint32_t first_id, uint32_t material,
                    uint32_t depth_or_triangle) {
    // World positions are relative to the eye, positions in the space to the centre of the space's bounds.
    const Affine map(transform);
    const Mat3 inverse = glm::inverse(map.linear);
    const Vec3 to_world_offset = map.point(blases_[space].origin) - scene_.camera.eye;
    shader::Instance record{};
    record.bvh = space + 1;
    record.first_id = first_id;
    record.material = material;
    record.depth_or_triangle = depth_or_triangle;
    for (int row = 0; row < 3; ++row) {
      record.to_local[row] = records::to_vec4({inverse[0][row], inverse[1][row], inverse[2][row]});
      record.to_world[row] = records::to_vec4({map.linear[0][row], map.linear[1][row], map.linear[2][row]},
                                              to_world_offset[row]);
    }
    packed_.instances.push_back(record);
  }

  // Takes note that shapes of a kind are made of a material. Returns the optical depth of each. A
  // shape weakens a shadow ray once. A mesh or patch has half the depth at each crossing, because a ray that
  // enters a closed body leaves it as well.
  uint32_t use_material(uint32_t kind, uint32_t material, bool at_each_crossing) {
    const uint32_t optical_depth = packed_.materials[material].optical_depth;
    packed_.uses.emplace(kind, material);
    translucent_ = translucent_ || optical_depth < OPTICAL_DEPTH_OPAQUE;
    return at_each_crossing && optical_depth < OPTICAL_DEPTH_OPAQUE ? optical_depth / 2 : optical_depth;
  }

  bool has_bounded(size_t least) const {
    size_t count = packed_.instances.size();
    for (auto box = world_.boxes.begin(); count < least && box != world_.boxes.end(); ++box)
      count += box->is_finite() ? 1 : 0;
    return count >= least;
  }

  bvh::BvhOptions bvh_options(const BlasRecords& items) const {
    bvh::BvhOptions options;
    options.first_lone = items.size();
    // An item that stands in two leaves would weaken a shadow ray twice; a CSG object of several materials
    // may do so too.
    options.split = options_.split && !translucent_ && !packed_.mixed_csg;
    options.cut = [&items](uint32_t item, int axis, float position) {
      if (item < items.size()) {
        const shader::Primitive primitive = items.record(item);
        if (kind_of(primitive) == shader::KIND_triangle) return cut_triangle(primitive, axis, position);
      }
      const bvh::Box everything{glm::vec3(-HUGE_VALF), glm::vec3(HUGE_VALF)};
      return std::pair(everything, everything);
    };
    return options;
  }

  bvh::Bvh build(const BlasRecords& items) const {
    return options_.history ? options_.history->build(items.boxes, bvh_options(items))
                            : build_bvh(items.boxes, bvh_options(items));
  }

  void build_bvhs() {
    if (options_.history) options_.history->begin_scene();
    packed_.quantised_nodes = true;
    for (Blas& space : blases_) {
      if (space.items.size() == 1) continue;
      space.bvh = build(space.items);
      free_memory(space.items.boxes);
      packed_.quantised_nodes = packed_.quantised_nodes && quantising_is_harmless(space.bvh);
    }
    for (const shader::Instance& instance : packed_.instances)
      world_.boxes.push_back(instance_box(instance, blases_[instance.bvh - 1].box));
    world_bvh_ = build(world_);
    packed_.quantised_nodes = packed_.quantised_nodes && quantising_is_harmless(world_bvh_);
  }

  // A ray is mapped into an instance with errors that grow with its coordinates, wherever the BVH's own
  // origin is. Seen from the world, the errors are |linear| · |inverse| times as large: at most 3 times if
  // axes are stretched and then turned, more under shears. A shape's own space has such errors too, but they
  // grow with the distance from its centre.
  static void make_room_for_maps(float growth, bool instances, shader::Bvh& bvh) {
    constexpr float harmless = 3;  // the growth that the boxes have room for without this
    if (!instances && growth <= harmless) return;
    // Twice: for the way into the space, and for a triangle's allowance for rounding there.
    bvh.slack = bvh.slack * 2 * growth;
    bvh.extent += glm::abs(bvh.origin);
  }

  // The largest growth of errors by a map: those of the world's own shapes, and those of the shapes that
  // instances transform to world space.
  float world_growth() const {
    float growth = packed_.map_growth;
    for (const shader::Instance& instance : packed_.instances)
      for (const shader::vec4& row : instance.to_world) {
        float sum = 0;
        for (int column = 0; column < 3; ++column)
          for (int k = 0; k < 3; ++k) sum += std::fabs(row[k] * instance.to_local[k][column]);
        growth = std::max(growth, sum * blases_[instance.bvh - 1].map_growth);
      }
    return growth;
  }

  // Lays out the world's slots: first the items in no BVH, by kind, then the others in the order of the BVH's
  // leaves.
  void lay_out_world() {
    std::vector<std::vector<uint32_t>> linear(shader::SHAPE_KINDS);
    for (uint32_t item = 0; item < world_.size(); ++item) {
      if (!packed_.has_bvh || !world_.boxes[item].is_finite())
        linear[world_.kind(item)].push_back(item);
      else
        packed_.bvh_kinds.insert(world_.kind(item));
    }
    free_memory(world_.boxes);
    for (const auto& items : linear) {
      append_records(items, world_);
      packed_.linear_ends.push_back(uint32_t(packed_.primitives.size()));
    }
    lay_out(world_bvh_, world_);
    if (packed_.has_bvh) make_room_for_maps(world_growth(), !packed_.instances.empty(), packed_.bvhs.back());
  }

  void lay_out_spaces() {
    for (Blas& space : blases_) {
      for (uint32_t item = 0; item < space.items.size(); ++item)
        packed_.bvh_kinds.insert(space.items.kind(item));
      if (!packed_.has_bvh || space.items.size() == 1) {
        space.bvh.order.resize(space.items.size());
        std::iota(space.bvh.order.begin(), space.bvh.order.end(), 0u);
      }
      lay_out(space.bvh, space.items);
      if (packed_.has_bvh) make_room_for_maps(space.map_growth, false, packed_.bvhs.back());
    }
    if (packed_.primitives.size() > MOST_SLOTS)
      throw Error(ExitCode::bad_input, "the scene has {} primitives in memory; at most {} can be addressed",
                  packed_.primitives.size(), MOST_SLOTS);
  }

  void lay_out(bvh::Bvh& bvh, const BlasRecords& items) {
    const auto first_slot = uint32_t(packed_.primitives.size());
    append_records(bvh.order, items);
    if (packed_.has_bvh && !bvh.nodes.empty()) {
      add_bvh(bvh, first_slot, items.size(), packed_);
    } else {
      // A single primitive is a leaf at the root.
      shader::Bvh& record = packed_.bvhs.emplace_back();
      record.root = LEAF | first_slot << 3;
      record.first_slot = first_slot;
      record.end_slot = uint32_t(packed_.primitives.size());
    }
    free_memory(bvh.nodes);
    free_memory(bvh.order);
  }

  void append_records(std::span<const uint32_t> order, const BlasRecords& items) {
    const size_t first = packed_.primitives.size();
    packed_.primitives.resize(first + order.size());
    parallel_for(0, int(order.size()),
                 [&](int i) { packed_.primitives[first + size_t(i)] = items.record(order[size_t(i)]); });
  }

  int deepest_space() const {
    int depth = 0;
    for (const Blas& space : blases_) depth = std::max(depth, space.bvh.depth);
    return depth;
  }

  const Scene& scene_;
  const PackOptions& options_;
  records::Packer& packer_;
  records::PackedScene& packed_;
  const PrimitiveIds ids_{scene_};
  std::vector<uint32_t> uses_;  // for each mesh
  BlasRecords world_;
  std::vector<Blas> blases_;  // by the BVH of instances, less one
  bvh::Bvh world_bvh_;
  bool use_bvh_ = false;
  bool translucent_ = false;
};

}  // namespace

void pack_geometry(const Scene& scene, const PackOptions& options, records::Packer& packer) {
  GeometryPacker(scene, options, packer).run();
}

}  // namespace eyeray::engine::pack
