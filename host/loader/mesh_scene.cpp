#include "loader/mesh_scene.hpp"

#include <algorithm>
#include <cmath>

#include "scene/affine.hpp"

namespace eyeray {

namespace {

constexpr double fov_degrees = 40;
const Vec3 towards_eye = glm::normalize(Vec3(0.6, 0.45, 1.0));
// How much of the picture's shorter side is left free.
constexpr double margin = 0.06;

toml::array list(const Vec3& v) {
  return toml::array{v.x, v.y, v.z};
}

Bounds world_bounds(const ImportedScene& import) {
  Bounds world;
  for (const Instance& instance : import.instances) {
    const Bounds mesh = bounds(import.meshes[static_cast<size_t>(instance.mesh)]);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec4 p(corner & 1 ? mesh.min.x : mesh.max.x, corner & 2 ? mesh.min.y : mesh.max.y,
                   corner & 4 ? mesh.min.z : mesh.max.z, 1);
      world.include(Vec3(instance.transform * p));
    }
  }
  return world;
}

// From where all of the box is seen, and little else, in pictures of any shape.
Camera framing(const Bounds& box) {
  Camera camera;
  camera.fov_degrees = fov_degrees;
  camera.fov_axis = FovAxis::shorter;
  camera.target = box.min + (box.max - box.min) / 2.0;
  const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0), towards_eye));
  const Vec3 up = glm::cross(towards_eye, right);
  const double slope = std::tan(glm::radians(fov_degrees / 2)) * (1 - margin);
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = Vec3(corner & 1 ? box.min.x : box.max.x, corner & 2 ? box.min.y : box.max.y,
                        corner & 4 ? box.min.z : box.max.z) -
                   camera.target;
    const double aside = std::max(std::fabs(glm::dot(p, right)), std::fabs(glm::dot(p, up)));
    distance = std::max(distance, glm::dot(p, towards_eye) + aside / slope);
  }
  camera.eye = camera.target + towards_eye * distance;
  return camera;
}

toml::table table(const Camera& camera) {
  constexpr std::string_view axes[] = {"horizontal", "vertical", "shorter", "diagonal"};
  toml::table table{{"eye", list(camera.eye)}, {"target", list(camera.target)}, {"up", list(camera.up)}};
  if (camera.type == CameraType::orthographic) {
    table.insert("type", "orthographic");
    table.insert("size", camera.size);
  } else {
    table.insert("fov", camera.fov_degrees);
    table.insert("fov_axis", axes[static_cast<size_t>(camera.fov_axis)]);
  }
  return table;
}

toml::table table(const Light& light) {
  toml::table table{{"intensity", list(light.intensity)}};
  if (light.type == LightType::point) {
    table.insert("type", "point");
    table.insert("position", list(light.position));
  } else {
    table.insert("type", "directional");
    table.insert("direction", list(-light.to_light));
  }
  return table;
}

// Over the left shoulder of whoever looks.
Light key_light(const Camera& camera) {
  const Vec3 back = unit(camera.eye - camera.target);
  const Vec3 right = unit(glm::cross(camera.up, back));
  Light light;
  light.type = LightType::directional;
  light.to_light = unit(0.75 * back - 0.6 * right + 0.8 * glm::cross(back, right));
  light.intensity = Vec3(0.85);
  return light;
}

}  // namespace

toml::table mesh_scene(const std::filesystem::path& file, const ImportedScene& import) {
  const Camera camera = import.camera ? *import.camera : framing(world_bounds(import));
  toml::array lights;
  for (const Light& light : import.lights) lights.push_back(table(light));
  if (lights.empty()) lights.push_back(table(key_light(camera)));

  toml::table root;
  root.insert("camera", table(camera));
  root.insert("render", toml::table{{"background", toml::array{0.34, 0.41, 0.5}}, {"ambient", 0.25}});
  root.insert("light", std::move(lights));
  root.insert("mesh", toml::array{toml::table{{"file", file.filename().string()}}});
  return root;
}

}  // namespace eyeray
