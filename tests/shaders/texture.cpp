// textures/image.glsl: which texels a point sees, how they are mixed, and the values of their codes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "host/loader/scene_file.hpp"
#include "host/textures/make.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::records;
using test::Random;
using textures::make_image;

namespace {

using Texel = std::array<uint8_t, 4>;

constexpr Filter filters[] = {Filter::bilinear, Filter::nearest};
constexpr Wrap wraps[] = {Wrap::repeat, Wrap::mirror, Wrap::clamp};

// An image of linear codes, so that expected values can be written down.
std::shared_ptr<ImageTexture> linear_image(int width, int height, std::vector<Texel> texels, Filter filter,
                                           Wrap wrap) {
  const auto image = std::make_shared<ImageTexture>();
  image->width = width;
  image->height = height;
  image->texels = std::move(texels);
  image->srgb = false;
  image->filter = filter;
  image->wrap_u = image->wrap_v = wrap;
  return image;
}

// The colour that the shader computes for `texture` at uv.
Vec3 shaded(const TexturePtr& texture, const Vec2& uv) {
  Packer packer(Vec3(0));
  const uint32_t index = texture->pack(packer);
  packer.write_texels();
  const shader::Binding binding(twin::view_of(packer.scene));
  return Vec3(shader::base_texture(index, shader::context_of_uv(glm::vec2(uv))));
}

Texel random_texel(Random& random) {
  const uint64_t bits = random.bits();
  return {uint8_t(bits), uint8_t(bits >> 8), uint8_t(bits >> 16), uint8_t(bits >> 24)};
}

}  // namespace

TEST_CASE("(0, 0) is the lower left corner, (1, 1) the upper right, and the file's first row is the top") {
  // red    green
  // blue   white
  const auto image =
      linear_image(2, 2, {{255, 0, 0, 255}, {0, 255, 0, 0}, {0, 0, 255, 9}, {255, 255, 255, 1}},
                   Filter::nearest, Wrap::clamp);
  const auto check = [&](const Vec2& uv, const Vec3& color) {
    CAPTURE(uv.x);
    CAPTURE(uv.y);
    CHECK(shaded(make_image(image), uv) == color);
    CHECK(make_image(image)->at(uv) == color);
  };
  const Vec3 red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1), white(1, 1, 1);
  check({0, 0}, blue);
  check({0.25, 0.75}, red);
  check({0.75, 0.75}, green);
  check({0.49, 0.49}, blue);
  check({0.51, 0.49}, white);
  check({1, 1}, green);
  check({7, -7}, white);
  check({-7, 7}, red);
}

TEST_CASE(
    "a row of texels continues beyond its edges as `wrap` sets, and bilinear filtering mixes across the "
    "seam") {
  // Codes 0, 1/5 … 1, once in a row, and once in a column from bottom to top.
  std::vector<Texel> row, column;
  for (int i = 0; i < 6; ++i) {
    const auto code = uint8_t(51 * i);
    row.push_back({code, code, code, 255});
    column.insert(column.begin(), row.back());
  }
  // The expected texel at i = −7 … 12, in fifths, worked out by hand.
  constexpr int from = -7;
  constexpr std::array<int, 20> expected[] = {
      {5, 0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5, 0},   // repeat
      {5, 5, 4, 3, 2, 1, 0, 0, 1, 2, 3, 4, 5, 5, 4, 3, 2, 1, 0, 0},   // mirror
      {0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5, 5, 5, 5, 5}};  // clamp
  for (const Wrap wrap : wraps) {
    for (int k = 0; k + 1 < 20; ++k) {
      const auto& texels = expected[int(wrap)];
      const double centre = (from + k + 0.5) / 6;
      CAPTURE(int(wrap));
      CAPTURE(from + k);
      const auto check = [&](Filter filter, double position, double value) {
        const TexturePtr row_image = make_image(linear_image(6, 1, row, filter, wrap));
        const TexturePtr upward = make_image(linear_image(1, 6, column, filter, wrap));
        CHECK(std::abs(shaded(row_image, {position, 0.3}).x - value) < 2e-6);
        CHECK(std::abs(shaded(upward, {0.3, position}).y - value) < 2e-6);
        CHECK(std::abs(row_image->at(Vec2{position, 0.3}).z - value) < 1e-14);
        CHECK(std::abs(upward->at(Vec2{0.3, position}).x - value) < 1e-14);
      };
      const double here = texels[size_t(k)] / 5.0, next = texels[size_t(k) + 1] / 5.0;
      check(Filter::nearest, centre, here);
      check(Filter::nearest, centre + 0.49 / 6, here);
      check(Filter::nearest, centre - 0.49 / 6, here);
      check(Filter::bilinear, centre, here);
      check(Filter::bilinear, centre + 0.25 / 6, 0.75 * here + 0.25 * next);
      check(Filter::bilinear, centre + 0.5 / 6, 0.5 * here + 0.5 * next);
    }
  }
}

TEST_CASE("a border belongs to the texel of greater u or v, in mirrored copies too") {
  Random random(2);
  for (const Wrap wrap : wraps) {
    std::vector<Texel> texels;
    for (int i = 0; i < 8 * 4; ++i) texels.push_back(random_texel(random));
    const TexturePtr texture = make_image(linear_image(8, 4, texels, Filter::nearest, wrap));
    for (int i = -24; i < 24; ++i) {
      for (int j = -12; j < 12; ++j) {
        CAPTURE(int(wrap));
        CAPTURE(i);
        CAPTURE(j);
        const Vec2 border(i / 8.0, j / 4.0);
        CHECK(shaded(texture, border) == shaded(texture, border + Vec2(0.5 / 8, 0.5 / 4)));
        CHECK(texture->at(border) == texture->at(border + Vec2(0.5 / 8, 0.5 / 4)));
      }
    }
  }
}

TEST_CASE("codes are decoded by IEC 61966-2-1, or as shares of 255") {
  for (const bool srgb : {true, false}) {
    Vec3 last(-1);
    for (int code = 0; code < 256; ++code) {
      auto image =
          linear_image(1, 1, {{uint8_t(code), uint8_t(255 - code), 7, 0}}, Filter::nearest, Wrap::repeat);
      image->srgb = srgb;
      const Vec3 color = shaded(make_image(image), {0.3, 0.8});
      CHECK(glm::vec3(color) == glm::vec3(make_image(image)->at(Vec2{0.3, 0.8})));
      CHECK(color.x > last.x);
      if (!srgb) CHECK(color.x == double(float(code / 255.0)));
      // Values of the standard's formula, worked out by hand.
      const struct {
        int code;
        double linear;
      } known[] = {
          {0, 0},  {10, 0.003035269835}, {11, 0.003346535764}, {128, 0.2158605001}, {188, 0.5028864580},
          {255, 1}};
      for (const auto& k : known)
        if (srgb && code == k.code) CHECK(std::abs(color.x - k.linear) < 3e-8);
      last = color;
    }
  }
}

TEST_CASE("200 000 points of random images: the shader agrees with the formulas in float64") {
  Random random(3);
  double worst = 0;
  int compared = 0;
  for (int round = 0; round < 400; ++round) {
    // Sizes that are and are not powers of two; points near and far; pictures of any size in uv.
    constexpr int sizes[] = {1, 2, 3, 7, 16, 61, 128};
    const int width = sizes[random.below(7)], height = sizes[random.below(7)];
    std::vector<Texel> texels;
    for (int i = 0; i < width * height; ++i) texels.push_back(random_texel(random));
    const Filter filter = filters[random.below(2)];
    auto image = linear_image(width, height, std::move(texels), filter, wraps[random.below(3)]);
    image->wrap_v = wraps[random.below(3)];
    image->srgb = random.below(2) == 0;
    const Vec3 tint{random.uniform(), random.uniform(), random.uniform()};
    const Vec2 size{random.log_uniform(0.1, 10), random.log_uniform(0.1, 10)};
    const Vec2 lower_left{random.uniform(-2, 2), random.uniform(-2, 2)};
    const TexturePtr texture = make_image(image, tint, {.corner = lower_left, .size = size});

    Packer packer(Vec3(0));
    const uint32_t index = texture->pack(packer);
    packer.write_texels();
    const shader::Binding binding(twin::view_of(packer.scene));
    const double reach = random.log_uniform(0.5, 1000);
    for (int i = 0; i < 500; ++i) {
      const glm::vec2 uv(random.uniform(-reach, reach), random.uniform(-reach, reach));
      // The largest displacement of the point, in texels, by the roundings of a float32.
      const Vec2 texels_a_unit = Vec2(width, height) / size;
      const Vec2 position = (Vec2(uv) - lower_left) * texels_a_unit;
      const Vec2 error =
          ((glm::abs(Vec2(uv)) + glm::abs(lower_left)) * texels_a_unit * 5.0 + Vec2(width, height) * 3.0) *
          0x1p-24;
      const Vec2 to_border = glm::abs(position - glm::round(position));
      if (filter == Filter::nearest && (to_border.x <= error.x || to_border.y <= error.y)) continue;
      const Vec3 difference =
          glm::abs(Vec3(shader::base_texture(index, shader::context_of_uv(uv))) - texture->at(Vec2(uv)));
      const double allowed = (filter == Filter::nearest ? 0 : error.x + error.y) + 1e-6;
      worst = std::max(worst, std::max({difference.x, difference.y, difference.z}) / allowed);
      ++compared;
    }
  }
  MESSAGE(compared << " compared; the worst is " << worst << " of what is allowed");
  CHECK(compared > 190'000);
  CHECK(worst <= 1);
}

TEST_CASE("no uv leads outside the image") {
  // A scene of three images, the middle one without red: any red comes from a texel of its neighbours.
  constexpr float inf = std::numeric_limits<float>::infinity();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  Random random(4);
  std::vector<float> coordinates = {0.0f,    -0.0f,       1.0f,         -1.0f, 1e-45f,     -1e-45f,
                                    -1e-10f, 0.99999994f, -0.99999994f, 1e10f, -1e10f,     3e38f,
                                    -3e38f,  inf,         -inf,         nan,   8388607.5f, -8388607.5f};
  for (int i = 0; i < 40; ++i)
    coordinates.push_back(float(random.uniform(-1, 1) * random.log_uniform(1e-12, 1e12)));
  for (const Filter filter : filters) {
    for (const Wrap wrap : wraps) {
      for (const auto& [width, height] : {std::pair{1, 1}, {3, 1}, {1, 5}, {7, 4}}) {
        const size_t count = size_t(width * height);
        Packer packer(Vec3(0));
        make_image(linear_image(width, height + 1, std::vector<Texel>(count + size_t(width), {255, 0, 0, 0}),
                                filter, wrap))
            ->pack(packer);
        const auto image =
            linear_image(width, height, std::vector<Texel>(count, {0, 255, 51, 0}), filter, wrap);
        const uint32_t index = make_image(image)->pack(packer);
        make_image(linear_image(width, height + 2,
                                std::vector<Texel>(count + 2 * size_t(width), {254, 0, 0, 0}), filter, wrap))
            ->pack(packer);
        packer.write_texels();
        const shader::Binding binding(twin::view_of(packer.scene));
        for (const float u : coordinates)
          for (const float v : coordinates) {
            const glm::vec3 color = shader::base_texture(index, shader::context_of_uv({u, v}));
            CAPTURE(u);
            CAPTURE(v);
            REQUIRE(color == glm::vec3(0, 1, 0.2f));
            if (std::isfinite(u) && std::isfinite(v))
              REQUIRE(glm::length(make_image(image)->at(Vec2{u, v}) - Vec3(0, 1, 0.2)) < 1e-14);
          }
      }
    }
  }
}

TEST_CASE("images of the same texels share them; equal textures are one") {
  const std::vector<Texel> texels = {{1, 2, 3, 4}, {5, 6, 7, 8}};
  const auto image = linear_image(2, 1, texels, Filter::nearest, Wrap::clamp);
  const auto same = linear_image(1, 2, texels, Filter::bilinear, Wrap::repeat);
  const auto other = linear_image(2, 1, {{1, 2, 3, 4}, {5, 6, 7, 9}}, Filter::nearest, Wrap::clamp);
  Packer packer(Vec3(0));
  CHECK(make_image(image)->pack(packer) == 0);
  CHECK(make_image(image)->pack(packer) == 0);
  CHECK(make_image(same)->pack(packer) == 1);
  CHECK(packer.scene.texel_count == TEXELS_FIRST + 2);
  CHECK(make_image(other)->pack(packer) == 2);
  CHECK(packer.scene.texels.empty());
  packer.write_texels();
  REQUIRE(packer.scene.texels.size() == TEXELS_FIRST + 4);
  CHECK(packer.scene.texels[TEXELS_FIRST + 3] == 0x09070605u);
  CHECK(shader::image_width(packer.scene.textures[2]) == 2);
  CHECK(shader::image_height(packer.scene.textures[2]) == 1);
  CHECK(shader::image_first_texel(packer.scene.textures[2]) == TEXELS_FIRST + 2);
  CHECK(shader::image_flags(packer.scene.textures[2]) == shader::image_flags(packer.scene.textures[0]));
}

TEST_CASE("patterns in space: shader and reference agree at 400 000 points except at steps, as constructed") {
  const Scene scene = loader::load_scene("scenes/solid_patterns.toml");
  Random random(21);
  const Vec3 eye(3, -2, 5);
  std::set<uint32_t> kinds;
  for (const auto& material : scene.materials) {
    CAPTURE(material->name);
    Packer packer(eye);
    material->pack(packer);
    const uint32_t index = packer.scene.materials.back().base;
    kinds.insert(packer.scene.textures[index].kind);
    const shader::Binding binding(twin::view_of(packer.scene));
    int apart = 0;
    double worst = 0;
    constexpr int count = 50'000;
    for (int i = 0; i < count; ++i) {
      const glm::vec3 p(random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(-6, 6));
      const Vec3 difference = glm::abs(Vec3(shader::base_texture(index, {{0, 0}, {0, 0}, p})) -
                                       material->base_color({Vec2(0), Vec3(p) + eye}));
      const double most = std::max({difference.x, difference.y, difference.z});
      apart += most > 2e-4;
      worst = std::max(worst, most);
    }
    MESSAGE(material->name, ": ", apart, " of ", count, " apart, the worst by ", worst);
    CHECK(apart < count / 5000);
  }
  CHECK(kinds.size() == 7);
}
