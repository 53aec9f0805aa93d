// A piece of a plane with straight edges, perhaps with holes: for polygons and prisms.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/core/vec.hpp"
#include "host/scene/affine.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

// Vertices in order, clockwise or counter-clockwise; the last is joined to the first.
using Outline = std::vector<Vec3>;

inline constexpr double thinnest_region = 1e-9;

struct PlanarRegion {
  Outline outer;
  std::vector<Outline> holes = {};

  size_t size() const;  // number of vertices of all outlines
  // Unit, towards the side from which the outer outline runs counter-clockwise; (0, 0, 0) if that has no
  // area.
  Vec3 normal() const;
  // About twice its area over the square of its size; a region below `thinnest_region` counts as one without
  // area.
  double thickness() const;
  PlanarRegion transformed(const Affine& map) const;
};

// The reason why float32 cannot compute with a region in the world, or "".
std::string why_out_of_range(const PlanarRegion& region);

// Newell's area vector: the sum over the outline's triangles with its first vertex, in units of the square of
// the outline's size. It points to the side from which the outline runs counter-clockwise.
Vec3 area_of(const Outline& outline);
// Twice the area within an outline, signed: above 0 where it runs counter-clockwise.
double signed_area(std::span<const Vec2> outline);
// The winding number of an outline around a point, counter-clockwise.
int winding(std::span<const Vec2> outline, const Vec2& point);

// Vertices that are farther off the plane than this share of the outline's size are not off by mere rounding.
inline constexpr double most_unevenness = 1e-5;
inline constexpr size_t most_outline_vertices = 16384;

// `vertices` and `holes`: the keys of shapes that are made of a region.
inline constexpr Key vertices_key{.name = "vertices",
                                  .type = KeyType::vec3_list,
                                  .doc = "Corners of the outline, in order. The last is joined to the first.",
                                  .min = -max_coordinate,
                                  .max = max_coordinate};
inline constexpr Key holes_key{.name = "holes",
                               .type = KeyType::outlines,
                               .doc = "Outlines of holes, in either direction.",
                               .fallback = "[]",
                               .min = -max_coordinate,
                               .max = max_coordinate};

// The reason why a region is none. `outline` 0 is the outer one, and `other` the outline that it crosses.
struct RegionFault {
  size_t outline = 0;
  std::optional<size_t> vertex = {};
  size_t other = 0;
  std::string message = {};
};
// The first fault of a region: its outlines must be flat, have an area and at least 3 vertices each, no two
// at the same point. They must neither cross nor touch themselves or each other. If `nested`, holes must lie
// within the outer outline, beside each other.
std::optional<RegionFault> find_fault(const PlanarRegion& region, bool nested);

// The region in a table with these keys. If it is invalid, returns nothing and reports one error, at the
// vertex that is to blame.
std::optional<PlanarRegion> read_region(TableReader& table);

}  // namespace eyeray::engine::shapes
