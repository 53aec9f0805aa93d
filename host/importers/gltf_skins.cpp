#include "importers/gltf_skins.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/affine.hpp"

namespace eyeray {

namespace {

// What maps normals, up to a factor: perpendicular to what the map makes of two edges.
Mat3 cofactors(const Mat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

// The attribute's elements, as many as there are vertices.
template <typename T>
void check_count(const GltfObject& owner, const std::vector<T>& elements, const VertexPool& vertices) {
  if (elements.size() != vertices.positions.size()) owner.fail("do not all have as many elements");
}

}  // namespace

std::vector<Mat4> joint_matrices(const GltfObject& document, GltfBuffers& buffers, size_t skin,
                                 std::span<const std::optional<Mat4>> worlds) {
  const GltfObject source = document.element("skins", skin);
  const std::vector<size_t> joints = source.indices("joints", worlds.size());
  std::vector<Mat4> inverse(joints.size(), Mat4(1.0));
  if (const auto accessor = source.index("inverseBindMatrices", document.size("accessors"))) {
    inverse = buffers.mat4(*accessor);
    if (inverse.size() < joints.size()) source.fail("has fewer inverseBindMatrices than joints");
  }
  std::vector<Mat4> matrices;
  for (size_t i = 0; i < joints.size(); ++i) {
    const std::optional<Mat4>& world = worlds[joints[i]];
    if (!world) return {};
    matrices.push_back(*world * inverse[i]);
  }
  return matrices;
}

void add_targets(const GltfObject& primitive, std::span<const double> weights, const GltfObject& document,
                 GltfBuffers& buffers, VertexPool& vertices) {
  const size_t count = std::min(weights.size(), primitive.size("targets"));
  for (size_t i = 0; i < count; ++i) {
    if (weights[i] == 0) continue;
    const GltfObject target = primitive.element("targets", i);
    const auto add = [&](const char* name, std::vector<Vec3>& to) {
      const auto accessor = target.index(name, document.size("accessors"));
      if (!accessor || to.empty()) return;
      const std::vector<Vec3> change = buffers.vec3(*accessor);
      check_count(target, change, vertices);
      for (size_t k = 0; k < to.size(); ++k) to[k] += weights[i] * change[k];
    };
    add("POSITION", vertices.positions);
    add("NORMAL", vertices.normals);
  }
}

void move_to_joints(const GltfObject& attributes, std::span<const Mat4> joints, const GltfObject& document,
                    GltfBuffers& buffers, VertexPool& vertices) {
  // Sum up by sets of four: JOINTS_0, JOINTS_1, …
  std::vector<Mat4> sums(vertices.positions.size(), Mat4(0.0));
  std::vector<double> total(vertices.positions.size(), 0.0);
  for (int set = 0;; ++set) {
    const size_t accessors = document.size("accessors");
    const auto which = attributes.index(fmt::format("JOINTS_{}", set).c_str(), accessors);
    const auto share = attributes.index(fmt::format("WEIGHTS_{}", set).c_str(), accessors);
    if (!which || !share) break;
    const std::vector<Vec4> numbers = buffers.vec4(*which);
    const std::vector<Vec4> weights = buffers.vec4(*share);
    check_count(attributes, numbers, vertices);
    check_count(attributes, weights, vertices);
    for (size_t i = 0; i < numbers.size(); ++i) {
      for (int k = 0; k < 4; ++k) {
        const double weight = weights[i][k];
        if (!(weight > 0)) continue;
        if (!(numbers[i][k] >= 0 && numbers[i][k] < static_cast<double>(joints.size())))
          attributes.fail(fmt::format("name joint {}; there are {}", numbers[i][k], joints.size()));
        sums[i] += joints[static_cast<size_t>(numbers[i][k])] * weight;
        total[i] += weight;
      }
    }
  }

  // A vertex that no joint holds is held by the first.
  for (size_t i = 0; i < sums.size(); ++i) {
    const Mat4 matrix = total[i] > 0 ? sums[i] / total[i] : joints[0];
    vertices.positions[i] = Vec3(matrix * Vec4(vertices.positions[i], 1));
    if (!vertices.normals.empty()) vertices.normals[i] = cofactors(Mat3(matrix)) * vertices.normals[i];
  }
}

}  // namespace eyeray
