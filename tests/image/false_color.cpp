#include "host/image/false_color.hpp"

#include <limits>
#include <set>

#include "host/core/vec.hpp"
#include "host/image/image_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Image row(std::vector<float> samples, int channels = 1) {
  Image image(int(samples.size()) / channels, 1, channels);
  image.samples() = std::move(samples);
  return image;
}

// The colour of pixel x that the .png shows.
glm::ivec3 shown(const Image& image, int x) {
  const float* p = image.pixel(x, 0);
  return {srgb8(p[0]), srgb8(p[1]), srgb8(p[2])};
}
int brightness(const Image& image, int x) {
  const glm::ivec3 c = shown(image, x);
  return c.x + c.y + c.z;
}

const glm::ivec3 grey = shown(false_color(row({infinity, 1}), FalseColor::scalar), 0);

}  // namespace

TEST_CASE("viridis goes from violet to yellow, over the range of the data") {
  const Image image = false_color(row({-5, 0, 5}), FalseColor::scalar);
  const glm::ivec3 low = shown(image, 0), middle = shown(image, 1), high = shown(image, 2);
  // Matplotlib's viridis: 440154, 21918c, fde725.
  for (const auto& [color, expected] : {std::pair{low, glm::ivec3(0x44, 0x01, 0x54)},
                                        {middle, glm::ivec3(0x21, 0x91, 0x8c)},
                                        {high, glm::ivec3(0xfd, 0xe7, 0x25)}}) {
    for (int c = 0; c < 3; ++c) CHECK(std::abs(color[c] - expected[c]) <= 4);
  }
}

TEST_CASE("near is bright, and a miss is grey") {
  const Image image = false_color(row({1, 2, 100, infinity}), FalseColor::depth);
  CHECK(brightness(image, 0) > brightness(image, 1));
  CHECK(brightness(image, 1) > brightness(image, 2));
  CHECK(shown(image, 3) == grey);
}

TEST_CASE("neighbouring ids differ, and no id is grey") {
  std::vector<float> ids;
  for (int i = -1; i < 64; ++i) ids.push_back(float(i));
  const Image image = false_color(row(ids), FalseColor::ids);
  CHECK(shown(image, 0) == grey);
  std::set<std::tuple<int, int, int>> seen;
  for (int i = 1; i < 65; ++i) seen.insert({shown(image, i).x, shown(image, i).y, shown(image, i).z});
  CHECK(seen.size() == 64);
}

TEST_CASE("a direction's colour is (direction + 1) / 2, and no direction is grey") {
  const Image image = false_color(row({1, 0, -1, 0, 0, 0}, 3), FalseColor::direction);
  CHECK(shown(image, 0) == glm::ivec3(255, 128, 0));
  CHECK(shown(image, 1) == grey);
}

TEST_CASE("positions fill the range of each axis") {
  const Image image = false_color(row({-3, 0, 7, 1, 2, 7, infinity, 1, 7}, 3), FalseColor::position);
  CHECK(shown(image, 0) == glm::ivec3(0, 0, 0));
  CHECK(shown(image, 1) == glm::ivec3(255, 255, 0));
  CHECK(shown(image, 2) == grey);
}

TEST_CASE("data without any value is grey all over") {
  for (const FalseColor kind : {FalseColor::scalar, FalseColor::depth}) {
    const Image image = false_color(row({infinity, infinity}), kind);
    CHECK(shown(image, 0) == grey);
    CHECK(shown(image, 1) == grey);
  }
}

TEST_CASE("a picture in pieces gets the same false colours as the whole") {
  const std::vector<float> samples{1, 2, 0, -7, 100, infinity, 3, 0, 5, -1, 8, 0.5f};
  for (const auto& [kind, channels] :
       {std::pair{FalseColor::scalar, 1}, {FalseColor::depth, 1}, {FalseColor::position, 3}}) {
    const Image whole = false_color(row(samples, channels), kind);
    const std::vector<float> first(samples.begin(), samples.begin() + 6);
    const std::vector<float> second(samples.begin() + 6, samples.end());
    FalseColorPainter painter(kind, channels);
    painter.see(row(first, channels));
    painter.see(row(second, channels));
    std::vector<float> painted = painter.paint(row(first, channels)).samples();
    const std::vector<float> rest = painter.paint(row(second, channels)).samples();
    painted.insert(painted.end(), rest.begin(), rest.end());
    CHECK(painted == whole.samples());
  }
}
