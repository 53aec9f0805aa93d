// Union, intersection and difference of closed shapes.
#pragma once

#include <memory>
#include <vector>

#include "host/scene/shape.hpp"

namespace eyeray::engine::shapes {

// Limit on the leaves of a CSG object with all objects nested in it: in the shaders each leaf is a bit of a
// word.
inline constexpr size_t most_csg_leaves = 32;

class Csg final : public Shape {
 public:
  using Shapes = std::vector<std::unique_ptr<Shape>>;

  // The points within any of `operands` (if `all`: within all of them) and within none of `removed`. There is
  // at least one operand. All shapes are closed, at most most_csg_leaves together.
  Csg(bool all, Shapes operands, Shapes removed);

  std::optional<Intersection> intersect(const Ray& ray) const override;
  SurfacePoint surface(const Ray& ray, const Intersection& hit) const override;
  // A single point if the object is empty.
  Bounds bounds() const override;
  // True if bounds alone show that nothing is within it.
  bool is_empty() const;
  const Shape& part(const Intersection& hit) const override { return *leaves_[hit.part].shape; }
  bool is_closed() const override { return true; }
  std::vector<Span> spans(const Ray& ray) const override;
  ShapeForm form() const override;
  void pack(records::Packer& packer) const override;

 private:
  // A shape that is no CSG object, from this object or one nested in it. Leaves are sorted by kind in
  // registry order, then by the order of the operands. A leaf's index is its number as a part.
  struct Leaf {
    const Shape* shape;
    uint32_t kind;
    bool removed;  // its outside counts, not its inside
  };
  // A set of points: a leaf, or the union or intersection of nodes. A difference is an intersection with
  // complements of leaves.
  struct Node {
    bool is_leaf;
    uint32_t leaf;
    bool all;
    std::vector<Node> operands;
  };

  static Node node_of(bool all, std::vector<Node> operands);
  Node node_of_operand(size_t operand, bool complement) const;
  Node node(bool complement) const;
  size_t operand_count() const { return operands_.size() + removed_.size(); }
  const Shape& operand(size_t i) const {
    return *(i < operands_.size() ? operands_[i] : removed_[i - operands_.size()]);
  }
  std::vector<Span> spans_of(size_t operand, const Ray& ray) const;
  Bounds bounds_of_operands() const;  // min above max where they do not overlap

  bool all_;
  Shapes operands_, removed_;
  std::vector<Leaf> leaves_;
  struct Ball {
    Vec3 center;
    double radius;
  };
  std::vector<Ball> balls_;                   // around the operands, removed ones last
  std::vector<std::vector<uint32_t>> parts_;  // by operand, removed ones last: the numbers of its parts here
};

}  // namespace eyeray::engine::shapes
