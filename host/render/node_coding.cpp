#include "render/node_coding.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace eyeray {
namespace {

constexpr double largest_code = 65535;

// Where planes at q = 0 … 65535 stand.
struct Grid {
  explicit Grid(const accel::Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto lower = double(box.lower[axis]);
      const auto upper = double(box.upper[axis]);
      // A little room, also for a box without extent.
      const double margin = std::ldexp(std::max({std::fabs(lower), std::fabs(upper), 1e-30}), -20);
      origin[axis] = float(lower - margin);
      step[axis] =
          std::nextafter(float((upper + margin - double(origin[axis])) / (largest_code - 1)), HUGE_VALF);
    }
  }
  double plane(int axis, double code) const { return double(origin[axis]) + code * double(step[axis]); }
  // The greatest code whose plane is not above x, and the least whose plane is not below.
  uint32_t code_below(int axis, float x) const {
    double code =
        std::clamp(std::floor((double(x) - double(origin[axis])) / double(step[axis])), 0.0, largest_code);
    while (code > 0 && plane(axis, code) > double(x)) --code;
    return uint32_t(code);
  }
  uint32_t code_above(int axis, float x) const {
    double code =
        std::clamp(std::ceil((double(x) - double(origin[axis])) / double(step[axis])), 0.0, largest_code);
    while (code < largest_code && plane(axis, code) < double(x)) ++code;
    return uint32_t(code);
  }

  glm::vec3 origin, step;
};

uint32_t reference(const accel::Child& child, uint32_t first_node, uint32_t kind, const accel::Tree& tree,
                   std::span<const uint32_t> first_slots, uint32_t instance_kind) {
  if (!child.leaf) return first_node + child.index;
  if (kind == instance_kind) return INSTANCE_LEAF | tree.order[child.index];
  return LEAF | (first_slots[kind] + child.index) << 3 | (child.count - 1);
}

shader::uvec4 quantised(const accel::Box& box, const Grid& grid, uint32_t refers_to) {
  shader::uvec4 code(0, 0, 0, refers_to);
  for (int axis = 0; axis < 3; ++axis)
    code[axis] = grid.code_below(axis, box.lower[axis]) | grid.code_above(axis, box.upper[axis]) << 16;
  return code;
}

}  // namespace

bool quantising_is_harmless(const accel::Tree& tree) {
  double exact = 0;
  double coded = 0;
  const glm::dvec3 step(Grid(tree.box).step);
  for (const accel::Node& node : tree.nodes)
    for (const accel::Child& child : node.children) {
      const glm::dvec3 size(child.box.upper - child.box.lower);
      const glm::dvec3 wider = size + step;  // two planes, each off by half a step in the mean
      exact += size.x * size.y + size.y * size.z + size.z * size.x;
      coded += wider.x * wider.y + wider.y * wider.z + wider.z * wider.x;
    }
  return coded <= 1.1 * exact;
}

void add_tree(const accel::Tree& tree, std::span<const uint32_t> first_slots, uint32_t instance_kind,
              PackedScene& scene) {
  const size_t width = scene.quantised_nodes ? 2 : 4;  // uvec4 a node
  const Grid grid(tree.box);
  const auto first_node = uint32_t(scene.nodes.size() / width);
  scene.nodes.reserve(scene.nodes.size() + tree.nodes.size() * width);
  for (const accel::Node& node : tree.nodes) {
    for (const accel::Child& child : node.children) {
      const auto kind = uint32_t(std::upper_bound(tree.kind_ends.begin(), tree.kind_ends.end(), child.index) -
                                 tree.kind_ends.begin());
      const uint32_t refers_to = reference(child, first_node, kind, tree, first_slots, instance_kind);
      if (scene.quantised_nodes) {
        scene.nodes.push_back(quantised(child.box, grid, refers_to));
      } else {
        shader::uvec4 low = to_bits(shader::vec4(child.box.lower, 0.0f));
        low.w = refers_to;
        scene.nodes.push_back(low);
        scene.nodes.push_back(to_bits(shader::vec4(child.box.upper, 0.0f)));
      }
    }
  }
  CHECK_LT(scene.nodes.size() / width, size_t{LEAF});

  shader::Tree record{};
  record.head.x = first_node;
  if (scene.quantised_nodes) {
    record.origin = shader::vec4(grid.origin, 0.0f);
    record.step = shader::vec4(grid.step, 0.0f);
    record.extent = shader::vec4(grid.step * float(largest_code), 0.0f);
  } else {
    record.step = shader::vec4(1.0f, 1.0f, 1.0f, 0.0f);
    record.extent = shader::vec4(glm::max(glm::abs(tree.box.lower), glm::abs(tree.box.upper)), 0.0f);
  }
  record.extent.w = 0x1p-18f;
  scene.trees.push_back(record);
}

}  // namespace eyeray
