#include "host/importers/gltf_skins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"
#include "host/importers/gltf_components.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::importers {

namespace {

// The matrix that maps normals, up to a factor: a mapped normal is perpendicular to the mapped edges.
Mat3 cofactors(const Mat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

// Checks that there are as many elements of an attribute as vertices.
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
    const GltfObject matrices = document.element("accessors", *accessor);
    if (matrices.count("componentType", 0) != floating)
      matrices.fail("contains inverseBindMatrices, which must be floats");
    inverse = buffers.mat4(*accessor);
    for (const Mat4& m : inverse) {
      const Vec4 last(m[0].w, m[1].w, m[2].w, m[3].w - 1);
      if (!(glm::length(last) < 1e-4))
        matrices.fail("contains inverseBindMatrices, whose last rows must be 0, 0, 0, 1");
    }
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
                 GltfBuffers& buffers, GltfBreaches& breaches, VertexPool& vertices) {
  const size_t count = primitive.size("targets");
  if (!weights.empty() && weights.size() != count)
    primitive.fail(fmt::format("has {} targets, but {} weights", count, weights.size()));
  for (size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0) continue;
    const GltfObject target = primitive.element("targets", i);
    const auto add = [&](const char* name, std::vector<Vec3>& to) {
      const auto accessor = target.index(name, document.size("accessors"));
      if (!accessor || to.empty()) return;
      breaches.check_attribute(name, *accessor);
      const std::vector<Vec3> change = buffers.vec3(*accessor);
      check_count(target, change, vertices);
      for (size_t k = 0; k < to.size(); ++k) to[k] += weights[i] * change[k];
    };
    add("POSITION", vertices.positions);
    add("NORMAL", vertices.normals);
  }
}

void check_targets(const GltfObject& primitive, const GltfObject& document, GltfBuffers& buffers,
                   GltfBreaches& breaches) {
  const size_t accessors = document.size("accessors");
  for (size_t i = 0; i < primitive.size("targets"); ++i) {
    const GltfObject target = primitive.element("targets", i);
    breaches.check_attribute_names(target);
    const auto attributes = primitive.object("attributes");
    for (const char* name : {"POSITION", "NORMAL", "TANGENT"}) {
      try {
        const auto change = target.index(name, accessors);
        if (!change) continue;
        const auto base = attributes ? attributes->index(name, accessors) : std::nullopt;
        if (!base) {
          breaches.add("morph targets of attributes that the mesh lacks, left out", target.location());
        } else if (buffers.vec3(*change).size() != document.element("accessors", *base).count("count", 0)) {
          target.fail("do not all have as many elements");
        }
      } catch (const Error&) {
        breaches.add("morph targets that could not be shown with a weight", target.location());
      }
    }
  }
}

void move_to_joints(const GltfObject& attributes, std::span<const Mat4> joints, const GltfObject& document,
                    GltfBuffers& buffers, GltfBreaches& breaches, VertexPool& vertices) {
  // Sum up the joints' matrices by sets of four: JOINTS_0, JOINTS_1, …
  std::vector<Mat4> sums(vertices.positions.size(), Mat4(0.0));
  std::vector<double> total(vertices.positions.size(), 0.0);
  bool no_weight = false, no_joint = false, twice = false;
  if (!attributes.has("JOINTS_0")) attributes.fail("have no JOINTS_0, but the mesh is shown with a skin");
  for (int set = 0;; ++set) {
    const size_t accessors = document.size("accessors");
    const std::string joints_name = fmt::format("JOINTS_{}", set),
                      weights_name = fmt::format("WEIGHTS_{}", set);
    const auto which = attributes.index(joints_name.c_str(), accessors);
    const auto share = attributes.index(weights_name.c_str(), accessors);
    if (which.has_value() != share.has_value())
      attributes.fail(fmt::format("have one of {} and {} without the other", joints_name, weights_name));
    if (!which) break;
    breaches.check_attribute(joints_name, *which);
    breaches.check_attribute(weights_name, *share);
    const std::vector<Vec4> numbers = buffers.vec4(*which);
    const std::vector<Vec4> weights = buffers.vec4(*share);
    check_count(attributes, numbers, vertices);
    check_count(attributes, weights, vertices);
    for (size_t i = 0; i < numbers.size(); ++i) {
      for (int k = 0; k < 4; ++k) {
        const double weight = weights[i][k];
        const bool known = numbers[i][k] >= 0 && numbers[i][k] < static_cast<double>(joints.size());
        if (!(weight >= 0)) no_weight = true;
        if (!known && !(weight > 0)) no_joint = true;
        if (!(weight > 0)) continue;
        if (!known)
          attributes.fail(fmt::format("name joint {}, but there are {}", numbers[i][k], joints.size()));
        for (int j = 0; j < k; ++j) twice = twice || (numbers[i][j] == numbers[i][k] && weights[i][j] > 0);
        sums[i] += joints[static_cast<size_t>(numbers[i][k])] * weight;
        total[i] += weight;
      }
    }
  }

  if (no_weight)
    breaches.add("weights below 0 or not finite, set to 0", attributes.location() + ".WEIGHTS_0");
  if (no_joint)
    breaches.add("vertices that name joints beyond the skin's without weight, left out",
                 attributes.location() + ".JOINTS_0");
  if (twice)
    breaches.add("vertices that name a joint twice, whose weights are added",
                 attributes.location() + ".JOINTS_0");
  if (std::ranges::any_of(total, [](double sum) { return !(std::abs(sum - 1) < 0.02); }))
    breaches.add("weights of joints that do not sum to 1, divided by their sum",
                 attributes.location() + ".WEIGHTS_0");

  // A vertex to which no joint gives weight moves with the first joint.
  for (size_t i = 0; i < sums.size(); ++i) {
    const Mat4 matrix = total[i] > 0 ? sums[i] / total[i] : joints[0];
    vertices.positions[i] = Vec3(matrix * Vec4(vertices.positions[i], 1));
    if (!vertices.normals.empty()) vertices.normals[i] = cofactors(Mat3(matrix)) * vertices.normals[i];
  }
}

}  // namespace eyeray::engine::importers
