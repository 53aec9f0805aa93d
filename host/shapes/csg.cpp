#include "host/shapes/csg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/error.hpp"
#include "host/records/packer.hpp"
#include "host/scene/affine.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/registry.hpp"
#include "host/shapes/spans.hpp"

namespace eyeray::engine::shapes {

namespace {

uint32_t kind_of(const Shape& shape) {
  records::Packer packer(Vec3(0));
  shape.pack(packer);
  return shader::kind_of(packer.scene.primitives[0]);
}

bool is_deferred(uint32_t kind) {
#define NUMBER(name, number) number,
  constexpr uint32_t kinds[] = {DEFERRED_LEAVES(NUMBER)};
#undef NUMBER
  return std::ranges::find(kinds, kind) != std::end(kinds);
}

std::pair<Vec3, Vec3> center_and_half(const Bounds& bounds) {
  const Vec3 half = (bounds.max - bounds.min) * 0.5;
  return {bounds.min + half, half};
}

}  // namespace

Csg::Csg(bool all, Shapes operands, Shapes removed)
    : all_(all), operands_(std::move(operands)), removed_(std::move(removed)) {
  CHECK(!operands_.empty());
  std::vector<std::pair<size_t, uint32_t>> origins;  // by leaf: its operand, and its number there
  std::vector<Leaf> leaves;
  for (size_t i = 0; i < operand_count(); ++i) {
    const bool is_removed = i >= operands_.size();
    CHECK(operand(i).is_closed());
    const auto* csg = dynamic_cast<const Csg*>(&operand(i));
    const auto own = csg ? csg->leaves_ : std::vector{Leaf{&operand(i), kind_of(operand(i)), false}};
    for (Leaf leaf : own) {
      leaf.removed = leaf.removed != is_removed;
      leaves.push_back(leaf);
    }
    for (uint32_t number = 0; number < own.size(); ++number) origins.emplace_back(i, number);
    parts_.emplace_back(own.size());
    const auto [center, half] = center_and_half(operand(i).bounds());
    balls_.push_back({center, 1.0001 * glm::length(half)});
  }
  CHECK_LE(leaves.size(), most_csg_leaves);

  std::vector<size_t> order(leaves.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, {}, [&](size_t i) { return leaves[i].kind; });
  for (uint32_t number = 0; number < order.size(); ++number) {
    const auto& [from, part] = origins[order[number]];
    parts_[from][part] = number;
    leaves_.push_back(leaves[order[number]]);
  }
}

std::vector<Span> Csg::spans_of(size_t operand_index, const Ray& ray) const {
  const auto& [center, radius] = balls_[operand_index];
  if (glm::length(glm::cross(center - ray.o, ray.d)) > radius * glm::length(ray.d)) return {};
  std::vector<Span> spans = operand(operand_index).spans(ray);
  for (Span& span : spans) {
    span.in.part = parts_[operand_index][span.in.part];
    span.out.part = parts_[operand_index][span.out.part];
  }
  return spans;
}

std::vector<Span> Csg::spans(const Ray& ray) const {
  std::optional<Intersection> gave_up;
  const auto look_at = [&](size_t i) {
    std::vector<Span> spans = spans_of(i, ray);
    for (const auto& [in, out] : spans)
      for (const Intersection& crossing : {in, out})
        if (crossing.iteration_limit && !(gave_up && gave_up->t < crossing.t)) gave_up = crossing;
    return spans;
  };
  std::vector<Span> spans = look_at(0);
  for (size_t i = 1; i < operand_count(); ++i) {
    const std::vector<Span> other = look_at(i);
    spans = i >= operands_.size() ? subtract(spans, other)
            : all_                ? shapes::intersect(spans, other)
                                  : unite(spans, other);
  }
  // If the search in an operand gave up, nothing is known beyond that point.
  if (gave_up) {
    std::erase_if(spans, [&](const Span& span) { return span.in.t >= gave_up->t; });
    if (!spans.empty() && spans.back().out.t > gave_up->t)
      spans.back().out = *gave_up;
    else
      spans.push_back({*gave_up, *gave_up});
  }
  return spans;
}

std::optional<Intersection> Csg::intersect(const Ray& ray) const {
  for (const auto& [in, out] : spans(ray)) {
    if (in.t > 0 || in.iteration_limit) return in;
    if (out.t > 0 || out.iteration_limit) return out;
  }
  return std::nullopt;
}

// A subtracted shape shows its surface from within.
SurfacePoint Csg::surface(const Ray& ray, const Intersection& hit) const {
  const Leaf& leaf = leaves_[hit.part];
  SurfacePoint surface = leaf.shape->surface(ray, hit);
  if (leaf.removed) {
    surface.normal_geometric = -surface.normal_geometric;
    surface.normal = -surface.normal;
  }
  return surface;
}

Bounds Csg::bounds_of_operands() const {
  Bounds bounds = operands_[0]->bounds();
  for (const auto& operand : operands_) {
    const Bounds other = operand->bounds();
    bounds.min = all_ ? glm::max(bounds.min, other.min) : glm::min(bounds.min, other.min);
    bounds.max = all_ ? glm::min(bounds.max, other.max) : glm::max(bounds.max, other.max);
  }
  return bounds;
}

bool Csg::is_empty() const {
  const Bounds bounds = bounds_of_operands();
  return !(bounds.min.x < bounds.max.x && bounds.min.y < bounds.max.y && bounds.min.z < bounds.max.z);
}

Bounds Csg::bounds() const {
  const Bounds bounds = bounds_of_operands();
  const Vec3 middle = 0.5 * (bounds.min + bounds.max);
  return is_empty() ? Bounds{middle, middle} : bounds;
}

ShapeForm Csg::form() const {
  CsgForm form{all_, {}, {}};
  for (const auto& shape : operands_) form.operands.push_back(shape.get());
  for (const auto& shape : removed_) form.removed.push_back(shape.get());
  return form;
}

// Merges operands of the same operation into the node. If there is only one operand, returns it.
Csg::Node Csg::node_of(bool all, std::vector<Node> operands) {
  Node node{false, 0, all, {}};
  for (Node& operand : operands) {
    if (!operand.is_leaf && operand.all == all)
      std::ranges::move(operand.operands, std::back_inserter(node.operands));
    else
      node.operands.push_back(std::move(operand));
  }
  return node.operands.size() == 1 ? node.operands[0] : node;
}

Csg::Node Csg::node_of_operand(size_t i, bool complement) const {
  if (const auto* csg = dynamic_cast<const Csg*>(&operand(i))) {
    Node node = csg->node(complement);
    const auto renumber = [&](Node& of, const auto& self) -> void {
      if (of.is_leaf) of.leaf = parts_[i][of.leaf];
      for (Node& inner : of.operands) self(inner, self);
    };
    renumber(node, renumber);
    return node;
  }
  return {true, parts_[i][0], false, {}};
}

// De Morgan's laws move all complements to leaves, where `removed` marks them.
Csg::Node Csg::node(bool complement) const {
  std::vector<Node> operands;
  for (size_t i = 0; i < operands_.size(); ++i) operands.push_back(node_of_operand(i, complement));
  std::vector<Node> whole{node_of(all_ != complement, std::move(operands))};
  for (size_t i = operands_.size(); i < operand_count(); ++i)
    whole.push_back(node_of_operand(i, !complement));
  return node_of(!complement, std::move(whole));
}

void Csg::pack(records::Packer& packer) const {
  // The nodes, each after its operands.
  std::vector<shader::uvec4> nodes;
  const auto add = [&](const Node& node, const auto& self) -> uint32_t {
    shader::uvec4 record(0, 0, node.all || node.is_leaf ? 1 : 0, 0);
    for (const Node& operand : node.operands) {
      if (operand.is_leaf)
        record.x |= 1u << operand.leaf;
      else
        record.y |= 1u << self(operand, self);
    }
    if (node.is_leaf) record.x = 1u << node.leaf;
    nodes.push_back(record);
    return uint32_t(nodes.size() - 1);
  };
  add(node(false), add);
  CHECK_LT(nodes.size(), most_csg_leaves);

  // The leaves, as records among the vertices.
  std::vector<shader::uvec4> leaves;
  uint32_t removed = 0, deferred = 0;
  for (size_t i = 0; i < leaves_.size(); ++i) {
    leaves_[i].shape->pack(packer);
    const shader::Primitive leaf = packer.scene.primitives.back();
    packer.scene.primitives.pop_back();
    CHECK_EQ(shader::kind_of(leaf), leaves_[i].kind);
    const auto [center, half] = center_and_half(leaves_[i].shape->bounds());
    leaves.insert(leaves.end(),
                  {shader::head_of(leaf), records::to_bits(leaf.a), records::to_bits(leaf.b),
                   records::to_bits(leaf.c), records::to_bits(records::to_vec4(packer.relative(center))),
                   records::to_bits(records::to_vec4(half))});
    removed |= leaves_[i].removed ? 1u << i : 0;
    deferred |= is_deferred(leaves_[i].kind) ? 1u << i : 0;
  }
  const uint32_t extra =
      packer.add_vertices({{uint32_t(nodes.size()), removed, uint32_t(leaves_.size()), deferred}});
  packer.add_vertices(nodes);
  packer.add_vertices(leaves);

  // Each crossing takes one pass over all leaves; most leaves are crossed twice. Before the first, the box of
  // each leaf is tested, and each leaf is queried.
  packer.add_iterations((2 * leaves_.size() + 1) * (leaves_.size() + nodes.size() + 2) + 2 * leaves_.size());
  const auto [center, half] = center_and_half(bounds());
  packer.add(records::Packer::primitive(shader::KIND_csg, material, records::to_vec4(packer.relative(center)),
                                        records::to_vec4(half), shader::vec4(0), extra));
}

namespace {

constexpr std::string_view manual =
    R"(A combination of closed shapes (CSG object): their union, their intersection, or either minus other shapes.
The shapes are in the CSG object's table, `[[csg.sphere]]`, `[[csg.box]]` and so on. The shapes to subtract
are below `minus`: `[[csg.minus.cylinder]]`. Closed; the normals point out of the CSG object, also into the
subtracted shapes.

```toml
[[csg]]                        # a lens: the intersection of two balls
operation = "intersection"
material = "glass"

[[csg.sphere]]
center = [0, 1, -0.8]
radius = 1

[[csg.sphere]]
center = [0, 1, 0.8]
radius = 1

[[csg]]                        # a ring: a cylinder minus a thinner one
material = "wall"

[[csg.cylinder]]
from = [2, 0, 0]
to = [2, 0.5, 0]
radius = 0.6

[[csg.minus.cylinder]]
from = [2, -0.1, 0]              # a little longer than the outer cylinder
to = [2, 0.6, 0]
radius = 0.4
material = "floor"               # material of the ring's inner side
```

A CSG object may be part of another: `[[csg.csg]]`, `[[csg.minus.csg]]`. Parts and CSG objects may have a
`batch` and a `transform`. That of a CSG object moves all its parts, by any map that its parts may have. The
order of shapes does not matter in any table. A part without a `material` has that of the CSG object around
it.

Parts are closed shapes: sphere, box, ellipsoid, capsule, prism, torus, superellipsoid. Cylinder, cone,
paraboloid, hyperboloid, quadric and implicit are closed unless they are `open`. A CSG object has at most 32
parts, including those of CSG objects in it. eyeray refuses shapes that enclose nothing. It also refuses
meshes, because nothing states that they are closed.

An implicit part is slow where rays cross the CSG object often: a ray searches it from end to end once for
each crossing of the object's parts. At its 65th crossing the ray has reached the iteration limit. A CSG
object is filled with at most one medium. If light passes through several of its surfaces, they must have the
same material.

**uv.** The uv of the part whose surface is hit.

**Numeric trap.** Many renderers restart the ray a little behind each crossing. That misses thin walls or hits
the same surface twice. Here a ray is followed from t = −∞, where it is outside everything, from crossing to
crossing. Each crossing has the same t in every computation, and counting alone decides which parts the ray is
inside.

Rounding decides between faces of two parts at the same position. So let subtracted shapes stick out, as
above, and let joined shapes overlap. Faces at exactly the same t are crossed together, and nothing thin is
left. If two surfaces coincide, the visible one belongs to the first part: first by kind in the order of this
page, then by its position in the file.

**Source.** Roth: Ray Casting for Modeling Solids, Computer Graphics and Image Processing 18, 1982.
)";

constexpr std::string_view operations[] = {"union", "intersection"};
constexpr Key keys[] = {
    {.name = "operation",
     .type = KeyType::choice,
     .doc = "`\"union\"`: the points inside any of the parts. `\"intersection\"`: the points inside all of "
            "them. Parts below `minus` are subtracted.",
     .fallback = "\"union\"",
     .choices = operations,
     .hint = "; write subtracted shapes below `minus`, as [[csg.minus.sphere]]"},
};

std::unique_ptr<Shape> combine(TableReader& table, ShapeType::Shapes operands, ShapeType::Shapes removed) {
  size_t leaves = 0;
  for (const auto* list : {&operands, &removed})
    for (const auto& shape : *list) for_each_leaf(*shape, [&](const Shape&) { ++leaves; });
  if (operands.empty()) {
    table.error("operation", "the CSG object is empty: add a shape, such as [[csg.sphere]]");
  } else if (leaves > most_csg_leaves) {
    table.error("operation", fmt::format("the CSG object is made of {} shapes; at most {} are possible",
                                         leaves, most_csg_leaves));
  }
  if (table.failed()) return nullptr;
  const bool all = operations[size_t(table.choice("operation"))] == "intersection";
  auto csg = std::make_unique<Csg>(all, std::move(operands), std::move(removed));
  if (all && csg->is_empty())
    table.warning("operation",
                  "the CSG object is empty: no point is within all of its parts, as they do not overlap");
  return csg;
}

}  // namespace

extern const ShapeType csg_type{.name = "csg", .manual = manual, .keys = keys, .combine = combine};

std::unique_ptr<Shape> make_csg(bool all, std::vector<std::unique_ptr<Shape>> operands,
                                std::vector<std::unique_ptr<Shape>> removed) {
  return std::make_unique<Csg>(all, std::move(operands), std::move(removed));
}

}  // namespace eyeray::engine::shapes
