#include "host/importers/height_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "host/core/vec.hpp"

namespace eyeray::engine::importers {

namespace {

// The index of a texel that may lie one beyond an end.
int wrapped_index(int i, int size, Wrap wrap) {
  return wrap == Wrap::repeat ? (i + size) % size : std::clamp(i, 0, size - 1);
}

// A coordinate of a unit vector as a code.
uint8_t code_of(double coordinate) {
  return static_cast<uint8_t>(std::lround((coordinate + 1) / 2 * 255));
}

}  // namespace

bool has_normals(const ImageTexture& picture) {
  Vec3 sum(0);
  for (const auto& texel : picture.texels) sum += Vec3(texel[0], texel[1], texel[2]);
  const Vec3 apart = glm::abs(sum / double(picture.texels.size()) - Vec3(128, 128, 255));
  return apart.x < 32 && apart.y < 32 && apart.z < 64;
}

bool has_heights(const ImageTexture& picture) {
  constexpr int tint = 4;
  return std::ranges::all_of(picture.texels, [](const auto& texel) {
    return std::abs(texel[0] - texel[1]) <= tint && std::abs(texel[1] - texel[2]) <= tint;
  });
}

ImageTexture normals_of_heights(const ImageTexture& heights, double strength) {
  ImageTexture normals = heights;
  const auto height = [&](int column, int row) {
    const auto x = size_t(wrapped_index(column, heights.width, heights.wrap_u));
    const auto y = size_t(wrapped_index(row, heights.height, heights.wrap_v));
    return heights.texels[y * size_t(heights.width) + x][1] / 255.0;
  };
  size_t i = 0;
  for (int row = 0; row < heights.height; ++row) {
    for (int column = 0; column < heights.width; ++column) {
      // Rows go down, and v goes up.
      const double along_u = (height(column + 1, row) - height(column - 1, row)) / 2;
      const double along_v = (height(column, row - 1) - height(column, row + 1)) / 2;
      const Vec3 normal = glm::normalize(Vec3(-strength * along_u, -strength * along_v, 1));
      normals.texels[i++] = {code_of(normal.x), code_of(normal.y), code_of(normal.z), 255};
    }
  }
  return normals;
}

}  // namespace eyeray::engine::importers
