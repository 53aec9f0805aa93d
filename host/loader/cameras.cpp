#include "host/loader/cameras.hpp"

#include "host/cameras/registry.hpp"
#include "host/loader/kinds.hpp"

namespace eyeray::engine::loader {

namespace {

void check_view(reading::TableReader& table, const Camera& camera) {
  const Vec3 view = camera.target - camera.eye;
  const double reach = std::max(glm::length(camera.eye), glm::length(camera.target));
  if (!(glm::length(view) > 1e-12 * reach)) {
    table.error(table.has("target") ? "target" : "eye",
                "`eye` and `target` are the same point: the camera needs a direction");
    return;
  }
  if (camera.up == Vec3(0)) {
    table.error("up", "`up` has no length");
    return;
  }
  // The sine of the angle between view and `up` must be large enough for normalising their cross product.
  const double sine = glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up)));
  if (!(sine > 1e-9)) {
    table.error(table.has("up") ? "up" : "target",
                "`up` is parallel to the direction in which the camera looks (target − eye); choose another, "
                "such as [0, 0, 1]");
  }
}

}  // namespace

Camera read_camera(const Section& section, const toml::table* table, const reading::ValueSources& sources,
                   DiagnosticLog& log) {
  auto [type, reader] = read_kind(section, table, cameras::types(), sources, log);
  const Camera camera{.eye = reader.vec3("eye"),
                      .target = reader.vec3("target"),
                      .up = reader.vec3("up"),
                      .projection = type ? type->parse(reader) : nullptr};
  if (reader.valid("eye") && reader.valid("target") && reader.valid("up")) check_view(reader, camera);
  return camera;
}

}  // namespace eyeray::engine::loader
