// The kinds of shapes, as scene files and the manual know them.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "host/reading/table_reader.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine::shapes {

// The types with which each kind declares and reads its keys.
using reading::Key, reading::KeyType, reading::TableReader;

struct ShapeType {
  std::string_view name;      // its table in a scene, its .glsl, its scene file
  std::string_view manual;    // equation, parameters' meaning, the numeric trap, the source; Markdown
  std::span<const Key> keys;  // beside `name`, `material` and `transform`, which every shape has
  // Builds the shape from its table, with `transform` applied. Reports errors to the reader, and then returns
  // nullptr.
  std::unique_ptr<Shape> (*parse)(TableReader& table, const Mat4& transform) = nullptr;
  // Replaces `parse` for kinds that consist of other shapes: `operands` are those in the table, already
  // transformed, and `removed` are those to be subtracted.
  using Shapes = std::vector<std::unique_ptr<Shape>>;
  std::unique_ptr<Shape> (*combine)(TableReader& table, Shapes operands, Shapes removed) = nullptr;
  bool bounded = true;  // whether every such shape has an end in all directions
  // True if a ray hits it once at most, so that it may have a material with cutouts.
  bool flat = false;
  // True if its parts may overlap, so that it needs an opaque material.
  bool overlaps = false;
};

// Every kind of shape, in registry order: the order of Scene::shapes, hence of primitive indices.
std::span<const ShapeType* const> types();
// Tables whose shapes are of these kinds, made from other values: a blob is an implicit surface.
std::span<const ShapeType* const> made_types();

}  // namespace eyeray::engine::shapes
