#include "host/scene/tangents.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>

#include "host/scene/affine.hpp"
#include "host/scene/triangle.hpp"

namespace eyeray::engine {
namespace {

// Appends a copy of the vertex, and returns its index.
uint32_t split(Mesh& mesh, uint32_t vertex) {
  const auto again = [&](auto& values) {
    if (!values.empty())
      values.push_back(typename std::decay_t<decltype(values)>::value_type(values[vertex]));
  };
  again(mesh.positions);
  again(mesh.normals);
  again(mesh.uv);
  again(mesh.second_uv);
  again(mesh.colors);
  again(mesh.alphas);
  return uint32_t(mesh.positions.size() - 1);
}

// The normalised component of `d` perpendicular to the unit `n`; 0 if there is none.
Vec3 across(const Vec3& d, const Vec3& n) {
  const Vec3 left = d - n * glm::dot(n, d);
  return magnitude(left) > 1e-12 * magnitude(d) ? unit(left) : Vec3(0);
}

void add_tangents(Mesh& mesh) {
  constexpr uint32_t none = ~uint32_t{0};
  std::vector<Vec4> sums(mesh.positions.size(), Vec4(0));    // in w the side of v; 0: not known yet
  std::vector<uint32_t> other(mesh.positions.size(), none);  // the vertex for the other side
  const auto& uv = mesh.second_tangents ? mesh.second_uv : mesh.uv;
  for (auto& triangle : mesh.triangles) {
    const auto [a, b, c] = triangle;
    const Corners corners{mesh.positions[a], mesh.positions[b], mesh.positions[c]};
    const auto [along_u, along_v] = along_uv(corners, {uv[a], uv[b], uv[c]});
    const bool flat = !(magnitude(along_u) > 0 && std::isfinite(magnitude(along_u)));
    const double side = glm::dot(glm::cross(geometric_normal(corners), along_u), along_v) < 0 ? -1 : 1;
    for (size_t i = 0; i < 3 && !flat; ++i) {
      uint32_t& vertex = triangle[i];
      if (sums[vertex].w == -side) {
        if (other[vertex] == none) {
          other[vertex] = split(mesh, vertex);
          sums.push_back(Vec4(0));
          other.push_back(vertex);
        }
        vertex = other[vertex];
      }
      const Vec3 to_next = unit(corners[(i + 1) % 3] - corners[i]);
      const Vec3 to_last = unit(corners[(i + 2) % 3] - corners[i]);
      const double angle = std::acos(std::clamp(glm::dot(to_next, to_last), -1.0, 1.0));
      sums[vertex] += Vec4(angle * across(along_u, mesh.normals[vertex]), 0);
      sums[vertex].w = side;
    }
  }
  // If uv determine no tangent, any one will do.
  mesh.tangents.reserve(sums.size());
  for (size_t i = 0; i < sums.size(); ++i) {
    const Vec3& n = mesh.normals[i];
    Vec3 tangent = across(Vec3(sums[i]), n);
    if (tangent == Vec3(0)) tangent = across(std::abs(n.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0), n);
    mesh.tangents.emplace_back(tangent, sums[i].w < 0 ? -1 : 1);
  }
}

}  // namespace

void make_tangents(Scene& scene) {
  std::map<int, bool> wanted;  // by mesh: whether its tangents are along the second u
  const auto note = [&](const std::vector<Instance>& instances) {
    for (const Instance& instance : instances) {
      const Material& material = *scene.materials[size_t(instance.material)];
      const auto& map = material.normal_map ? material.normal_map : material.coat_normal_map;
      if (map) wanted.emplace(instance.mesh, map->texture->reads_second_uv());
    }
  };
  note(scene.instances);
  for (const Group& group : scene.groups) note(group.instances);
  for (const auto& [index, second] : wanted) {
    Mesh& mesh = scene.meshes[size_t(index)];
    if (mesh.normals.empty() || !mesh.tangents.empty()) continue;
    mesh.second_tangents = second && !mesh.second_uv.empty();
    if (mesh.second_tangents || !mesh.uv.empty()) add_tangents(mesh);
  }
}

}  // namespace eyeray::engine
