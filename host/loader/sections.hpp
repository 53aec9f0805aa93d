// Every table that may stand in a scene file: the one list from which reading, the schema and the manual go.
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
  std::span<const reading::Key> keys;        // of every such table …
  const shapes::ShapeType* shape = nullptr;  // … and where set, the shape's own
  std::string_view manual = {};              // the manual's addition to `doc`; Markdown

  bool many() const { return title.starts_with("[["); }
  // True if it stands in the world: such tables may have a batch, and may stand in a group.
  bool is_placed() const {
    return kind == Kind::shape || kind == Kind::mesh || kind == Kind::group || kind == Kind::instance;
  }
  // True if it is made of the shapes that stand in it.
  bool is_combined() const { return shape && shape->combine; }
};

// The values of `emission_side`.
inline constexpr std::string_view emission_sides[] = {"both", "front"};

// In the order in which the manual shows them; shapes in registry order.
std::span<const Section> sections();
// Null when there is no such table.
const Section* find_section(std::string_view name);
// "did you mean [[sphere]]?", or the names of all.
std::string suggest_section(std::string_view name);

// The names of those that may stand in a group.
std::span<const std::string_view> placed_names();

// The keys that all shapes in a CSG object share, as CSG objects do: a part without a material takes that of
// the object around it.
std::span<const reading::Key> part_keys();
// The table within a CSG object's table that has the parts taken away.
inline constexpr std::string_view minus_key = "minus";

// The key that lists the files to include, and the one that holds the batch of a placed table.
inline constexpr std::string_view include_key = "include";
inline constexpr std::string_view batch_key = "batch";

}  // namespace eyeray::engine::loader
