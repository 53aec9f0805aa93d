// Checks that importers' meshes and clouds keep the promises of scene/mesh.hpp and scene/point_cloud.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "host/importers/import.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/triangle.hpp"

namespace eyeray::engine::test {

inline bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The first promise that is broken, or "".
inline std::string broken_promise(const Mesh& mesh) {
  if (mesh.triangles.empty()) return "no triangles";
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) return "number of normals";
  if (!mesh.uv.empty() && mesh.uv.size() != mesh.positions.size()) return "number of uv";
  if (!mesh.second_uv.empty() && mesh.second_uv.size() != mesh.positions.size()) return "number of second uv";
  if (mesh.second_tangents && (mesh.second_uv.empty() || mesh.tangents.empty())) return "second tangents";
  if (!mesh.colors.empty() && mesh.colors.size() != mesh.positions.size()) return "number of colours";
  for (const Vec3& color : mesh.colors)
    for (int i = 0; i < 3; ++i)
      if (!(color[i] >= 0 && color[i] <= 1)) return "colour out of range";
  for (const Vec3& position : mesh.positions)
    if (!finite(position)) return "position not finite";
  for (const auto* set : {&mesh.uv, &mesh.second_uv})
    for (const Vec2& uv : *set)
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return "uv not finite";
  for (const auto& triangle : mesh.triangles) {
    for (const uint32_t vertex : triangle)
      if (vertex >= mesh.positions.size()) return "index out of range";
    const Corners corners{mesh.positions[triangle[0]], mesh.positions[triangle[1]],
                          mesh.positions[triangle[2]]};
    if (!(thickness(corners) >= thinnest_triangle)) return "triangle without area";
    if (mesh.normals.empty()) continue;
    const Vec3 geometric = geometric_normal(corners);
    for (const uint32_t vertex : triangle) {
      if (!(std::fabs(glm::length(mesh.normals[vertex]) - 1) < 1e-12)) return "normal not unit";
      if (!(glm::dot(mesh.normals[vertex], geometric) > least_normal_cosine))
        return "normal on the wrong side";
    }
  }
  return "";
}

inline std::string broken_promise(const importers::ImportedScene& scene) {
  for (const Mesh& mesh : scene.meshes)
    if (const std::string broken = broken_promise(mesh); !broken.empty()) return broken;
  if (scene.instances.empty() && scene.clouds.empty() && scene.lines.empty() && !scene.played)
    return "no instances";
  for (const auto& [cloud, material] : scene.clouds) {
    if (material < -1 || material >= int(scene.materials.size())) return "material of points";
    if (cloud->positions.empty()) return "no points";
    if (!cloud->colors.empty() && cloud->colors.size() != cloud->positions.size())
      return "number of points' colours";
    for (const Vec3& position : cloud->positions)
      if (!(magnitude(position) <= max_coordinate)) return "point out of range";
    for (const glm::vec3& color : cloud->colors)
      for (int i = 0; i < 3; ++i)
        if (!(color[i] >= 0 && color[i] <= 1)) return "colour of a point out of range";
    if (!cloud->normals.empty() && cloud->normals.size() != cloud->positions.size())
      return "number of points' normals";
    for (const glm::vec3& normal : cloud->normals)
      if (normal != glm::vec3(0.0f) && !(std::abs(glm::length(normal) - 1) < 1e-5f))
        return "normal of a point";
    if (!(cloud->radius >= min_radius && std::isfinite(cloud->radius))) return "radius of points";
  }
  for (const auto& [segments, radius, material] : scene.lines) {
    if (segments.empty()) return "no segments";
    if (material < -1 || material >= int(scene.materials.size())) return "material of lines";
    for (const auto& [from, to] : segments) {
      if (!finite(from) || !finite(to)) return "line not finite";
      if (!(magnitude(to - from) >= 1e-6 * radius && radius >= 1e-6 * magnitude(to - from)))
        return "size of a line";
    }
  }
  for (const Instance& instance : scene.instances) {
    if (instance.mesh < 0 || size_t(instance.mesh) >= scene.meshes.size()) return "mesh of an instance";
    if (instance.material < -1 || instance.material >= int(scene.materials.size()))
      return "material of an instance";
    if (!why_singular(instance.transform).empty()) return "transform of an instance";
  }
  for (const auto& light : scene.lights) {
    const auto* point = std::get_if<PointLight>(&light);
    const auto* sun = std::get_if<DirectionalLight>(&light);
    const auto* spot = std::get_if<SpotLight>(&light);
    if (spot && !(finite(spot->position) && finite(spot->intensity) && finite(spot->direction) &&
                  spot->inner >= 0 && spot->inner < spot->outer))
      return "spot light";
    if (point && !(finite(point->position) && finite(point->intensity))) return "point light";
    if (sun && !(finite(sun->to_light) && finite(sun->intensity))) return "directional light";
  }
  for (const auto& camera : scene.cameras)
    if (!finite(camera.eye) || !finite(camera.target)) return "camera";
  return "";
}

}  // namespace eyeray::engine::test
