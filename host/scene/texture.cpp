#include "scene/texture.hpp"

#include <algorithm>
#include <cmath>

#include "core/srgb.hpp"

namespace eyeray {

namespace {

// i of the endless row of texels that an image of `size` is continued to, as one of its own.
size_t wrapped(double i, int size, Wrap wrap) {
  const double n = size;
  double own = i;
  if (wrap == Wrap::repeat) own = i - n * std::floor(i / n);
  if (wrap == Wrap::mirror) {
    own = i - 2 * n * std::floor(i / (2 * n));
    if (own >= n) own = 2 * n - 1 - own;
  }
  return own > 0 ? static_cast<size_t>(std::min(own, n - 1)) : 0;  // and NaN is 0
}

// What a code stands for.
double decoded(uint8_t code, bool srgb) {
  static const auto curve = [] {
    std::array<double, 256> values;
    for (size_t i = 0; i < values.size(); ++i) values[i] = linear_from_srgb(static_cast<double>(i) / 255);
    return values;
  }();
  return srgb ? curve[code] : code / 255.0;
}

// Linear RGB of texel (i, j), counted from the lower left, of the plane that the image is continued to.
Vec3 texel(const ImageTexture& image, double i, double j) {
  const size_t row = static_cast<size_t>(image.height) - 1 - wrapped(j, image.height, image.wrap_v);
  const size_t column = wrapped(i, image.width, image.wrap_u);
  const auto& codes = image.texels[row * static_cast<size_t>(image.width) + column];
  return {decoded(codes[0], image.srgb), decoded(codes[1], image.srgb), decoded(codes[2], image.srgb)};
}

// `place` in texels.
Vec3 filtered(const ImageTexture& image, const Vec2& place) {
  if (image.filter == Filter::nearest) return texel(image, std::floor(place.x), std::floor(place.y));

  // Weigh each texel by the share of a texel's area around the place that it covers; its centre is at a
  // half-integer.
  const Vec2 corner = glm::floor(place - 0.5);
  const Vec2 share = place - 0.5 - corner;
  Vec3 sum(0);
  for (const double i : {0.0, 1.0}) {
    for (const double j : {0.0, 1.0}) {
      const double weight = (i > 0 ? share.x : 1 - share.x) * (j > 0 ? share.y : 1 - share.y);
      sum += weight * texel(image, corner.x + i, corner.y + j);
    }
  }
  return sum;
}

}  // namespace

Vec3 Texture::at(const Vec2& uv) const {
  if (image) return value * filtered(*image, uv / image_size * Vec2(image->width, image->height));
  if (!checker) return value;
  const double check = std::floor(uv.x / checker->size.x) + std::floor(uv.y / checker->size.y);
  return std::fmod(std::fabs(check), 2.0) < 0.5 ? checker->even : checker->odd;
}

}  // namespace eyeray
