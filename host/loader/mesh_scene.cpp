#include "host/loader/mesh_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/scene/affine.hpp"

namespace eyeray::engine::loader {

namespace {

constexpr double fov_degrees = 30;
const Vec3 towards_eye = glm::normalize(Vec3(0.6, 0.55, 1.0));
// The share of the picture's shorter side that the camera leaves free around the file.
constexpr double margin = 0.06;

toml::array list(const Vec3& v) {
  return toml::array{v.x, v.y, v.z};
}

// Limit on the vertices that the camera frames; if there are more, it frames the boxes of their meshes
// instead.
constexpr size_t most_points = 4'000'000;

// Calls visit(p) for points in the world that span all instances.
template <typename Visit>
void each_point(const importers::ImportedScene& import, const Visit& visit) {
  size_t count = 0;
  for (const Instance& instance : import.instances)
    count += import.meshes[static_cast<size_t>(instance.mesh)].positions.size();
  for (const Instance& instance : import.instances) {
    const Mesh& mesh = import.meshes[static_cast<size_t>(instance.mesh)];
    const auto move = [&](const Vec3& p) { visit(Vec3(instance.transform * Vec4(p, 1))); };
    if (count <= most_points) {
      for (const Vec3& position : mesh.positions) move(position);
    } else {
      const auto [low, high] = bounds(mesh);
      for (int corner = 0; corner < 8; ++corner) {
        move({corner & 1 ? low.x : high.x, corner & 2 ? low.y : high.y, corner & 4 ? low.z : high.z});
      }
    }
  }
}

// A camera that shows all of the file, and little else, in pictures of any aspect ratio.
importers::ImportedCamera framing(const importers::ImportedScene& import) {
  Bounds box;
  each_point(import, [&](const Vec3& p) { box.include(p); });
  const Vec3 centre = box.min + (box.max - box.min) / 2.0;

  // Four planes through the eye bound the view. Push each plane towards the points until it touches one. Two
  // opposite planes then intersect at the nearest possible eye for their axis. The farther of the two axes'
  // eyes sees everything, with equal margins on both sides.
  const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0), towards_eye));
  const Vec3 up = glm::cross(towards_eye, right);
  const double slope = std::tan(glm::radians(fov_degrees / 2)) * (1 - margin);
  constexpr double lowest = std::numeric_limits<double>::lowest();
  Vec2 most[2] = {Vec2(lowest),
                  Vec2(lowest)};  // along right and up: on the positive side; on the negative side
  each_point(import, [&](const Vec3& p) {
    const Vec3 from_centre = p - centre;
    const double nearer = slope * glm::dot(from_centre, towards_eye);
    const Vec2 lateral(glm::dot(from_centre, right), glm::dot(from_centre, up));
    most[0] = glm::max(most[0], lateral + nearer);
    most[1] = glm::max(most[1], -lateral + nearer);
  });
  const Vec2 middle = (most[0] - most[1]) / 2.0;
  const Vec2 distance = (most[0] + most[1]) / (2 * slope);

  importers::ImportedCamera camera;
  camera.form = PerspectiveCamera{fov_degrees, FovAxis::shorter};
  camera.target = centre + right * middle.x + up * middle.y;
  camera.eye = camera.target + towards_eye * std::max(distance.x, distance.y);
  return camera;
}

toml::table table(const PerspectiveCamera& camera) {
  return toml::table{{"type", "perspective"},
                     {"fov", camera.fov_degrees},
                     {"fov_axis", fov_axis_names[static_cast<size_t>(camera.fov_axis)]}};
}

toml::table table(const OrthographicCamera& camera) {
  return toml::table{{"type", "orthographic"}, {"size", camera.size}};
}

toml::table table(const importers::ImportedCamera& camera) {
  toml::table all = std::visit([](const auto& form) { return table(form); }, camera.form);
  all.insert("eye", list(camera.eye));
  all.insert("target", list(camera.target));
  all.insert("up", list(camera.up));
  return all;
}

toml::table table(const PointLight& light) {
  return toml::table{
      {"type", "point"}, {"intensity", list(light.intensity)}, {"position", list(light.position)}};
}

toml::table table(const DirectionalLight& light) {
  return toml::table{
      {"type", "directional"}, {"intensity", list(light.intensity)}, {"direction", list(-light.to_light)}};
}

toml::table table(const SpotLight& light) {
  return toml::table{{"type", "spot"},
                     {"intensity", list(light.intensity)},
                     {"position", list(light.position)},
                     {"direction", list(light.direction)},
                     {"inner_angle", glm::degrees(light.inner)},
                     {"outer_angle", std::min(glm::degrees(light.outer), 90.0)}};
}

// The two lights of a studio: a key light over the viewer's left shoulder, and a weak light from the right
// that gives the shadows form.
decltype(importers::ImportedScene::lights) studio_lights(const importers::ImportedCamera& camera) {
  const Vec3 back = unit(camera.eye - camera.target);
  const Vec3 right = unit(glm::cross(camera.up, back));
  const auto light = [&](double along_back, double along_right, double upward, double intensity) {
    return DirectionalLight{unit(along_back * back + along_right * right + upward * glm::cross(back, right)),
                            Vec3(intensity)};
  };
  return {light(0.75, -0.6, 0.8, 0.8), light(0.7, 1.0, 0.25, 0.28)};
}

}  // namespace

toml::table mesh_scene(const std::filesystem::path& file, const importers::ImportedScene& import,
                       const importers::ImportedScene& framed, bool around) {
  const importers::ImportedCamera camera = import.camera ? *import.camera : framing(framed);
  toml::array lights;
  for (const auto& light : import.lights.empty() && !around ? studio_lights(camera) : import.lights)
    lights.push_back(std::visit([](const auto& form) { return table(form); }, light));

  toml::table root;
  root.insert("camera", table(camera));
  if (!around)
    root.insert("render", toml::table{{"background", toml::array{0.34, 0.41, 0.5}}, {"ambient", 0.14}});
  root.insert("light", std::move(lights));
  root.insert("mesh", toml::array{toml::table{{"file", file.filename().string()}}});
  return root;
}

}  // namespace eyeray::engine::loader
