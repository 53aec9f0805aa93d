#include <algorithm>
#include <array>
#include <cmath>

#include "host/image/srgb.hpp"
#include "host/records/packer.hpp"
#include "host/textures/make.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

extern const TextureType image_type;

namespace {

constexpr std::string_view manual =
    R"(A picture, for any color that may vary over a surface. (0, 0) in uv is its lower left corner, and (`scale`,
`scale`) its upper right. See [scene-file.md](scene-file.md#images).
)";

constexpr std::string_view filters[] = {"bilinear", "nearest"};
constexpr std::string_view wraps[] = {"repeat", "mirror", "clamp"};
constexpr std::string_view color_spaces[] = {"srgb", "linear"};

constexpr Key keys[] = {
    {.name = "image",
     .type = KeyType::string,
     .doc = "Name of a PNG, JPEG, WebP, TIFF, BMP or TGA file, relative to the scene file that contains this "
            "key."},
    {.name = "filter",
     .type = KeyType::choice,
     .doc = "Interpolation between four texels, or the texel that contains the point.",
     .fallback = "'bilinear'",
     .choices = filters},
    {.name = "wrap",
     .type = KeyType::choice2,
     .doc = "Continuation of the picture beyond its edges.",
     .fallback = "'repeat'",
     .choices = wraps},
    {.name = "color_space",
     .type = KeyType::choice,
     .doc = "Meaning of the file's codes: sRGB, or unconverted shares of 255.",
     .fallback = "'srgb'",
     .choices = color_spaces},
    {.name = "scale",
     .type = KeyType::scale2,
     .doc = "Size of the whole picture in uv.",
     .fallback = "1",
     .min = 0,
     .above_min = true},
    {.name = "tint", .type = KeyType::color, .doc = "Factor for the picture's color.", .fallback = "1"},
};

// The index of the texel, in a row of `size` texels, that texel i of the row's endless continuation repeats.
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

// The value from 0 to 1 that an 8-bit code represents.
double decoded(uint8_t code, bool srgb) {
  static const auto curve = [] {
    std::array<double, 256> values;
    for (size_t i = 0; i < values.size(); ++i)
      values[i] = image::linear_from_srgb(static_cast<double>(i) / 255);
    return values;
  }();
  return srgb ? curve[code] : code / 255.0;
}

// Linear RGB and alpha of texel (i, j) of the image, endlessly continued. Texel (0, 0) is at the lower left.
Vec4 texel(const ImageTexture& image, bool srgb, double i, double j) {
  const size_t row = static_cast<size_t>(image.height) - 1 - wrapped(j, image.height, image.wrap_v);
  const size_t column = wrapped(i, image.width, image.wrap_u);
  const auto& codes = image.texels[row * static_cast<size_t>(image.width) + column];
  return {decoded(codes[0], srgb), decoded(codes[1], srgb), decoded(codes[2], srgb), codes[3] / 255.0};
}

// The filtered RGB and alpha at `uv`, where the whole image spans [0, 1].
Vec4 filtered(const ImageTexture& image, bool srgb, const Vec2& uv) {
  const Vec2 position = uv * Vec2(image.width, image.height);
  if (image.filter == Filter::nearest)
    return texel(image, srgb, std::floor(position.x), std::floor(position.y));

  // Weigh each texel by its overlap with a square of one texel around the point; texel centres are at
  // half-integers. Equal texels give exactly their value, so an alpha may be compared with it.
  const Vec2 corner = glm::floor(position - 0.5);
  const Vec2 share = position - 0.5 - corner;
  const auto row = [&](double j) {
    const Vec4 left = texel(image, srgb, corner.x, j);
    return left + (texel(image, srgb, corner.x + 1, j) - left) * share.x;
  };
  const Vec4 lower = row(corner.y);
  return lower + (row(corner.y + 1) - lower) * share.y;
}

constexpr uint32_t wrap_codes[] = {WRAP_REPEAT, WRAP_MIRROR, WRAP_CLAMP};  // indexed by Wrap

uint32_t flags_of(const ImageTexture& image, bool srgb, bool second_uv) {
  return (image.filter == Filter::nearest ? IMAGE_NEAREST : 0) | (srgb ? 0 : IMAGE_LINEAR) |
         (second_uv ? IMAGE_SECOND_UV : 0) | wrap_codes[size_t(image.wrap_u)] << IMAGE_WRAP_U_SHIFT |
         wrap_codes[size_t(image.wrap_v)] << IMAGE_WRAP_V_SHIFT;
}

class Image final : public Texture {
 public:
  Image(std::shared_ptr<const ImageTexture> image, bool srgb, const Vec3& tint, const ImagePosition& position)
      : image_(std::move(image)), srgb_(srgb), tint_(tint), position_(position) {}

  Vec3 at(const TextureContext& point) const override { return tint_ * Vec3(texel_mean(point)); }
  double alpha_at(const TextureContext& point) const override { return tint_.x * texel_mean(point).w; }
  TexturePtr as_data() const override { return std::make_shared<Image>(image_, false, tint_, position_); }
  bool reads_second_uv() const override { return position_.second_uv; }
  // The size of a texel in uv.
  double detail() const override {
    return std::min(position_.size.x / image_->width, position_.size.y / image_->height);
  }

  uint32_t pack(records::Packer& packer) const override {
    return packer.add(
        shader::Texture{.color = glm::vec3(tint_),
                        .kind = shader::TEXTURE_image,
                        .a = shader::vec4(0),
                        .b = shader::vec4(1.0 / position_.size, -position_.corner / position_.size),
                        .c = {uint32_t(image_->width), uint32_t(image_->height), packer.add_image(image_),
                              flags_of(*image_, srgb_, position_.second_uv)}});
  }

 private:
  Vec4 texel_mean(const TextureContext& point) const {
    const Vec2& uv = position_.second_uv ? point.second_uv : point.uv;
    return filtered(*image_, srgb_, (uv - position_.corner) / position_.size);
  }

  std::shared_ptr<const ImageTexture> image_;
  bool srgb_;
  Vec3 tint_;
  ImagePosition position_;
};

TexturePtr parse(TableReader& table) {
  if (table.failed()) return nullptr;  // else an error of the file would hide the table's errors
  const auto [wrap_u, wrap_v] = table.choice2("wrap");
  ImageTexture wanted;
  wanted.name = table.string("image");
  wanted.srgb = table.choice("color_space") == 0;
  wanted.filter = static_cast<Filter>(table.choice("filter"));
  wanted.wrap_u = static_cast<Wrap>(wrap_u);
  wanted.wrap_v = static_cast<Wrap>(wrap_v);
  auto image = table.load_image("image", std::move(wanted));
  return image ? make_image(std::move(image), table.color("tint"), {.size = table.scale2("scale")}) : nullptr;
}

}  // namespace

extern const TextureType image_type{.name = "image", .manual = manual, .keys = keys, .parse = parse};

TexturePtr make_image(std::shared_ptr<const ImageTexture> image, const Vec3& tint,
                      const ImagePosition& position) {
  const bool srgb = image->srgb;
  return std::make_shared<Image>(std::move(image), srgb, tint, position);
}

}  // namespace eyeray::engine::textures
