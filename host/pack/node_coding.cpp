#include "host/pack/node_coding.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"

namespace eyeray::engine::pack {
namespace {

constexpr double largest_code = 65535;

// The coordinates of planes at q = 0 … 65535.
struct Grid {
  explicit Grid(const bvh::Box& box) {
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
  // The greatest code whose plane is not above x, and the least code whose plane is not below x.
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

shader::uvec4 quantised(const bvh::Box& box, const Grid& grid, uint32_t refers_to) {
  shader::uvec4 code(0, 0, 0, refers_to);
  for (int axis = 0; axis < 3; ++axis)
    code[axis] = grid.code_below(axis, box.lower[axis]) | grid.code_above(axis, box.upper[axis]) << 16;
  return code;
}

}  // namespace

bool quantising_is_harmless(const bvh::Bvh& bvh) {
  const glm::dvec3 step(Grid(bvh.box).step);
  const auto area = [](const glm::dvec3& size) {
    return size.x * size.y + size.y * size.z + size.z * size.x;
  };
  // Areas of the exact and of the coded boxes. On average a coded plane is off by half a step, so a box is
  // larger by a step.
  const auto sum = parallel_sum(0, int(bvh.nodes.size()), [&](int i) {
    glm::dvec2 areas(0);
    for (const bvh::Child& child : bvh.nodes[size_t(i)].children) {
      const glm::dvec3 size(child.box.upper - child.box.lower);
      areas += glm::dvec2(area(size), area(size + step));
    }
    return areas;
  });
  return sum.y <= 1.1 * sum.x;
}

void add_bvh(const bvh::Bvh& bvh, uint32_t first_slot, uint32_t first_instance, records::PackedScene& scene) {
  const size_t width = scene.quantised_nodes ? 2 : 4;  // uvec4 a node
  const Grid grid(bvh.box);
  const size_t begin = scene.nodes.size();
  const auto first_node = uint32_t(begin / width);
  const auto reference = [&](const bvh::Child& child) {
    switch (child.type) {
      case bvh::ChildType::node:
        return first_node + child.index;
      case bvh::ChildType::leaf:
        return LEAF | (first_slot + child.index) << 3 | (child.count - 1u);
      case bvh::ChildType::lone_item:
        break;
    }
    return INSTANCE_LEAF | (child.index - first_instance);
  };
  scene.nodes.resize(begin + bvh.nodes.size() * width);
  CHECK_LT(scene.nodes.size() / width, size_t{LEAF});
  parallel_for(0, int(bvh.nodes.size()), [&](int i) {
    shader::uvec4* code = &scene.nodes[begin + size_t(i) * width];
    for (const bvh::Child& child : bvh.nodes[size_t(i)].children) {
      if (scene.quantised_nodes) {
        *code++ = quantised(child.box, grid, reference(child));
      } else {
        *code = records::to_bits(shader::vec4(child.box.lower, 0.0f));
        code++->w = reference(child);
        *code++ = records::to_bits(shader::vec4(child.box.upper, 0.0f));
      }
    }
  });

  shader::Bvh record{};
  record.root = first_node;
  record.first_slot = first_slot;
  record.end_slot = first_slot + uint32_t(bvh.order.size());
  if (scene.quantised_nodes) {
    record.origin = grid.origin;
    record.step = grid.step;
    record.extent = grid.step * float(largest_code);
  } else {
    record.step = glm::vec3(1);
    record.extent = glm::max(glm::abs(bvh.box.lower), glm::abs(bvh.box.upper));
  }
  record.slack = 0x1p-18f;
  scene.bvhs.push_back(record);
}

}  // namespace eyeray::engine::pack
