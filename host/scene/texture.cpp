#include "host/scene/texture.hpp"

#include <algorithm>
#include <cmath>

#include "host/image/srgb.hpp"

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

// Linear RGB and alpha of texel (i, j), counted from the lower left, of the plane that the image is continued
// to.
Vec4 texel(const ImageTexture& image, double i, double j) {
  const size_t row = static_cast<size_t>(image.height) - 1 - wrapped(j, image.height, image.wrap_v);
  const size_t column = wrapped(i, image.width, image.wrap_u);
  const auto& codes = image.texels[row * static_cast<size_t>(image.width) + column];
  return {decoded(codes[0], image.srgb), decoded(codes[1], image.srgb), decoded(codes[2], image.srgb),
          codes[3] / 255.0};
}

// `uv` in the image's own unit.
Vec4 filtered(const ImageTexture& image, const Vec2& uv) {
  const Vec2 place = uv * Vec2(image.width, image.height);
  if (image.filter == Filter::nearest) return texel(image, std::floor(place.x), std::floor(place.y));

  // Weigh each texel by how much of a texel's area around the place it covers; its centre is at a
  // half-integer. Equal ones give that very value, which an alpha may be compared with.
  const Vec2 corner = glm::floor(place - 0.5);
  const Vec2 share = place - 0.5 - corner;
  const auto row = [&](double j) {
    const Vec4 left = texel(image, corner.x, j);
    return left + (texel(image, corner.x + 1, j) - left) * share.x;
  };
  const Vec4 lower = row(corner.y);
  return lower + (row(corner.y + 1) - lower) * share.y;
}

// Of two checks, whether it is the odd one.
bool is_odd(const Checker& checker, const Vec2& uv) {
  const double check = std::floor(uv.x / checker.size.x) + std::floor(uv.y / checker.size.y);
  return std::fmod(std::fabs(check), 2.0) >= 0.5;
}

}  // namespace

Vec3 Texture::at(const Vec2& uv) const {
  if (image) return value * Vec3(filtered(*image, uv / image_size));
  if (!checker) return value;
  return is_odd(*checker, uv) ? checker->odd : checker->even;
}

double Texture::alpha_at(const Vec2& uv) const {
  return image ? value.x * filtered(*image, uv / image_size).w : at(uv).x;
}

}  // namespace eyeray
