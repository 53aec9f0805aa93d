// Every table that may stand in a scene file. Reading, the schema and the manual all use this one list.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/reading/key.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::loader {

struct Section {
  enum class Kind {
    let,
    image,
    camera,
    render,
    environment,
    medium,
    verify,
    animation,
    track,
    light,
    material,
    group,
    instance,
    mesh,
    shape
  };

  Kind kind;
  std::string_view name;
  std::string title;  // "[camera]", "[[sphere]]"
  std::string_view doc;
  std::span<const reading::Key> keys;        // the table's keys …
  const shapes::ShapeType* shape = nullptr;  // … for shapes, in addition to the shape's own
  std::string_view manual = {};              // the manual's addition to `doc`; Markdown

  bool many() const { return title.starts_with("[["); }
  // True if the table is an object in the world. Such a table may have a batch or be repeated, and may stand
  // in a group.
  bool is_placed() const {
    return kind == Kind::shape || kind == Kind::mesh || kind == Kind::group || kind == Kind::instance;
  }
  // True if the shape is combined from the shapes that stand in its table.
  bool is_combined() const { return shape && shape->combine; }
};

// The values of the key `emission_side`.
inline constexpr std::string_view emission_sides[] = {"both", "front"};

// All tables, in the order in which the manual shows them; shapes in registry order.
std::span<const Section> sections();
// The table of that name, or null.
const Section* find_section(std::string_view name);
// The hint for an unknown name: "did you mean [[sphere]]?", or the names of all tables.
std::string suggest_section(std::string_view name);

// The names of the tables that may stand in a group.
std::span<const std::string_view> placed_names();

// The keys that all parts of a CSG object have, be they shapes or CSG objects. A part without a material
// takes that of the object around it.
std::span<const reading::Key> part_keys();
// The table within a CSG object's table that contains the parts to take away.
inline constexpr std::string_view minus_key = "minus";

// The key that lists the files to include, and the keys that make many objects of a table.
inline constexpr std::string_view include_key = "include";
inline constexpr std::string_view batch_key = "batch";
inline constexpr std::string_view repeat_key = "repeat";

}  // namespace eyeray::engine::loader
