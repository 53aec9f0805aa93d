#include "host/reading/transform.hpp"

#include <glm/ext/matrix_transform.hpp>

#include "host/reading/source_position.hpp"
#include "host/reading/table.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::reading {

namespace {

constexpr Key step_keys[] = {
    {.name = "translate", .type = KeyType::vec3, .doc = "Moves by [x, y, z].", .optional = true},
    {.name = "rotate",
     .type = KeyType::rotation,
     .doc = "Rotates about an axis through the origin.",
     .optional = true},
    {.name = "scale",
     .type = KeyType::scale3,
     .doc = "Scales from the origin. Negative numbers mirror.",
     .optional = true},
    {.name = "matrix",
     .type = KeyType::matrix,
     .doc = "Any affine map, as three rows of four numbers.",
     .optional = true},
};

constexpr Key turn_keys[] = {
    {.name = "axis", .type = KeyType::vec3, .doc = "Direction of the axis, of any length but 0."},
    {.name = "degrees",
     .type = KeyType::number,
     .doc = "Angle, counter-clockwise when the axis points at the viewer."},
};

}  // namespace

std::span<const Key> transform_step_keys() {
  return step_keys;
}
std::span<const Key> rotation_keys() {
  return turn_keys;
}

std::optional<Mat4> read_rotation(const toml::table& table, DiagnosticLog& log, const ValueSources& sources) {
  TableReader reader =
      read_table({.title = "rotate", .table = &table, .keys = {turn_keys}, .sources = sources}, log);
  const Vec3 axis = reader.vec3("axis");
  if (!(glm::length(axis) >= 1 / largest_number)) reader.error("axis", "the rotation axis has no length");
  if (reader.failed()) return std::nullopt;
  return glm::rotate(Mat4(1.0), glm::radians(reader.number("degrees")), glm::normalize(axis));
}

std::optional<Mat4> read_transform(const toml::array& steps, DiagnosticLog& log,
                                   const ValueSources& sources) {
  Mat4 map(1.0);
  bool ok = true;
  for (const toml::node& node : steps) {
    // A step is a table with one key.
    const toml::table* table = node.as_table();
    if (!table || table->size() != 1) {
      log.error(position_of(node.source()),
                "a step of `transform` must be a table with one of translate, rotate, scale, matrix, such as "
                "{ translate = [1, 0, 0] }");
      ok = false;
      continue;
    }
    TableReader step =
        read_table({.title = "transform", .table = table, .keys = {step_keys}, .sources = sources}, log);
    if (step.has("scale")) {
      const Vec3 scale = step.scale3("scale");
      if (scale.x == 0 || scale.y == 0 || scale.z == 0)
        step.error("scale", "`scale` by 0 flattens the shape");
      map = glm::scale(Mat4(1.0), scale) * map;
    }
    if (step.has("translate")) map = glm::translate(Mat4(1.0), step.vec3("translate")) * map;
    if (step.has("rotate")) map = step.transform("rotate") * map;
    if (step.has("matrix")) map = step.transform("matrix") * map;
    ok = ok && !step.failed();
  }
  if (!ok) return std::nullopt;
  if (const std::string why = why_singular(map); !why.empty()) {
    log.error(position_of(steps.source()), "`transform` cannot be inverted: " + why);
    return std::nullopt;
  }
  return map;
}

}  // namespace eyeray::engine::reading
