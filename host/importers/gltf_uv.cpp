#include "host/importers/gltf_uv.hpp"

#include <cmath>

namespace eyeray::engine::importers {
namespace {

std::optional<textures::ImagePosition> position_in(const GltfUv& known, const GltfUv& wanted) {
  if (known == wanted) return textures::ImagePosition{};
  if (known.set != wanted.set) return std::nullopt;
  // The map from known to wanted uv, both with v from the bottom, is p → scale · p + shift.
  Vec2 scale, shift;
  for (int i = 0; i < 2; ++i) {
    const Vec2 from(known.linear[0][i], known.linear[1][i]), to(wanted.linear[0][i], wanted.linear[1][i]);
    scale[i] = glm::dot(from, to) / glm::dot(from, from);
    if (!(scale[i] > 0) || !std::isfinite(1 / scale[i]) ||
        glm::length(to - scale[i] * from) > 1e-9 * glm::length(to))
      return std::nullopt;
    const double from_offset = i == 0 ? known.offset.x : 1 - known.offset.y,
                 to_offset = i == 0 ? wanted.offset.x : 1 - wanted.offset.y;
    shift[i] = to_offset - scale[i] * from_offset;
  }
  return textures::ImagePosition{.corner = -shift / scale, .size = 1.0 / scale};
}

}  // namespace

GltfUv uv_of(const GltfObject& reference) {
  GltfUv uv;
  uv.set = reference.count("texCoord", 0);
  if (const auto transform = reference.extension("KHR_texture_transform")) {
    const std::vector<double> offset = transform->numbers("offset", {0, 0});
    const std::vector<double> scale = transform->numbers("scale", {1, 1});
    const double turn = transform->number("rotation", 0);
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    uv.set = transform->count("texCoord", uv.set);
    uv.linear = glm::dmat2(c * scale[0], -s * scale[0], s * scale[1], c * scale[1]);
    uv.offset = Vec2(offset[0], offset[1]);
  }
  return uv;
}

std::optional<textures::ImagePosition> position_among(std::span<const GltfUv> known, const GltfUv& wanted) {
  for (size_t i = 0; i < known.size(); ++i)
    if (auto position = position_in(known[i], wanted)) {
      position->second_uv = i == 1;
      return position;
    }
  return std::nullopt;
}

}  // namespace eyeray::engine::importers
