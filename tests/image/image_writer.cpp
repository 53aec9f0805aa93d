// Pictures that come in rows, a few at a time.
#include "host/image/image_writer.hpp"

#include <algorithm>
#include <bit>

#include "host/image/image_file.hpp"
#include "host/image/pfm_file.hpp"
#include "tests/support/process.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using eyeray::engine::test::Random;
using eyeray::engine::test::read_text;
using eyeray::engine::test::TemporaryFolder;
using eyeray::engine::test::write_text;

namespace {

// Noise, flat areas and gradients, so that every filter and kind of run is used.
Image mixed_image(int width, int height, int channels) {
  Random random(uint64_t(width * 1000 + height * 10 + channels));
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width * channels; ++x) {
      const int kind = (x / 40 + y) % 3;
      image.pixel(0, y)[x] = kind == 0   ? float(random.uniform(0, 1.2))
                             : kind == 1 ? 0.25f
                                         : float(x) / float(width * channels);
    }
  }
  return image;
}

Image rows_of(const Image& image, int first, int count) {
  Image rows(image.width(), count, image.channels());
  const float* begin = image.samples().data() + size_t(first) * size_t(image.width() * image.channels());
  std::copy_n(begin, rows.sample_count(), rows.samples().begin());
  return rows;
}

void write_in_pieces(const std::string& path, const Image& image, Random& random) {
  ImageWriter writer(path, image.width(), image.height(), image.channels());
  for (int y = 0; y < image.height();) {
    const int count = 1 + random.below(std::min(5, image.height() - y));
    writer.write(rows_of(image, y, count));
    y += count;
  }
  writer.finish();
}

constexpr int sizes[][2] = {{1, 1}, {1, 9}, {7, 5}, {8, 3}, {9, 4}, {129, 2}, {301, 13}, {40000, 2}};

}  // namespace

TEST_CASE("pieces make the same file as the whole, and every format gives the pixels back") {
  const TemporaryFolder folder;
  Random random(1);
  for (const auto& size : sizes) {
    const auto& [width, height] = size;
    for (const int channels : {1, 3}) {
      CAPTURE(size[0]);
      CAPTURE(channels);
      const Image image = mixed_image(width, height, channels);
      for (const std::string name : {"a.png", "a.pfm", "a.hdr", "a.exr"}) {
        CAPTURE(name);
        write_image(folder / name, image);
        const std::string whole = read_text(folder / name);
        write_in_pieces(folder / name, image, random);
        CHECK(read_text(folder / name) == whole);
        CHECK(folder.names() == std::set<std::string>{name});

        const Image read = read_image(folder / name);
        REQUIRE(read.width() == width);
        REQUIRE(read.height() == height);
        int different = 0;
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            const float* was = image.pixel(x, y);
            const float* is = read.pixel(x, y);
            for (int c = 0; c < read.channels(); ++c) {
              const float value = was[std::min(c, channels - 1)];
              const float largest = channels == 3 ? std::max({was[0], was[1], was[2]}) : value;
              if (name == "a.png") different += srgb8(is[c]) != srgb8(value);
              if (name == "a.pfm" || name == "a.exr")
                different += std::bit_cast<uint32_t>(is[c]) != std::bit_cast<uint32_t>(value);
              if (name == "a.hdr") different += !(value - is[c] >= 0 && value - is[c] <= largest / 128);
            }
          }
        }
        CHECK(different == 0);
        std::filesystem::remove(folder / name);
      }
    }
  }
}

TEST_CASE("flat pictures give small files, since formats with runs use them") {
  const TemporaryFolder folder;
  write_image(folder / "a.hdr", Image(1000, 10, 3));
  CHECK(std::filesystem::file_size(folder / "a.hdr") < 1000);
  write_image(folder / "a.png", Image(1000, 10, 3));
  CHECK(std::filesystem::file_size(folder / "a.png") < 1000);
}

TEST_CASE("an unfinished picture leaves no trace, and the old file unchanged") {
  const TemporaryFolder folder;
  const Image image = mixed_image(20, 4, 3);
  for (const std::string name : {"a.png", "a.pfm", "a.hdr", "a.exr"}) {
    write_text(folder / name, "old");
    {
      ImageWriter writer(folder / name, 20, 8, 3);
      writer.write(image);
      CHECK(folder.names().size() == 2);
    }
    CHECK(folder.names() == std::set<std::string>{name});
    CHECK(read_text(folder / name) == "old");
    std::filesystem::remove(folder / name);
  }
}

TEST_CASE("two writers of one file leave one of the two pictures, whole") {
  const TemporaryFolder folder;
  const Image first = mixed_image(50, 6, 3), second = mixed_image(50, 6, 1);
  ImageWriter a(folder / "a.pfm", 50, 6, 3), b(folder / "a.pfm", 50, 6, 1);
  a.write(first);
  b.write(second);
  a.finish();
  CHECK(read_image(folder / "a.pfm").samples() == first.samples());
  b.finish();
  CHECK(read_image(folder / "a.pfm").samples() == second.samples());
}

TEST_CASE("rows of a written PFM can be read from any position") {
  const TemporaryFolder folder;
  for (const int channels : {1, 3}) {
    const Image image = mixed_image(17, 11, channels);
    write_image(folder / "a.pfm", image);
    PfmRows rows(folder / "a.pfm", 17, 11, channels);
    for (const auto& [first, count] : {std::pair{0, 11}, {10, 1}, {3, 5}, {0, 1}})
      CHECK(rows.read(first, count).samples() == rows_of(image, first, count).samples());
  }
  CHECK_THROWS_AS(PfmRows(folder / "none.pfm", 1, 1, 1).read(0, 1), Error);
  write_text(folder / "a.pfm", read_text(folder / "a.pfm").substr(0, 300));
  CHECK_THROWS_AS(PfmRows(folder / "a.pfm", 17, 11, 3).read(0, 11), Error);
}
