// OpenEXR: written values come back, and files that others wrote are read or refused with a clear sentence.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"
#include "host/image/image_file.hpp"
#include "host/image/image_writer.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

// Files written by the library's own tools: 9 × 5 pixels. At (x, y), channel c (in the order of the file's
// list) is (x + 10 y + 100 c) / 4.
const std::string corpus = "tests/fuzz/corpus/exr/";

float value(int channel, int x, int y) {
  return float(x + 10 * y + 100 * channel) / 4;
}

// True if `image` is that picture with these channels, each value within `error`.
bool holds(const Image& image, const std::vector<int>& channels, float error = 0) {
  if (image.width() != 9 || image.height() != 5 || image.channels() != int(channels.size())) return false;
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 9; ++x)
      for (size_t c = 0; c < channels.size(); ++c) {
        const float expected = channels[c] < 0 ? 0 : value(channels[c], x, y);
        if (!(std::abs(image.pixel(x, y)[c] - expected) <= error)) return false;
      }
  return true;
}

std::string refusal_of(const std::string& file, const std::string& layer = "") {
  try {
    read_image(file, layer);
    return "";
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::file_io);
    const std::string begin = "cannot read " + file + " as EXR: ", text = error.what();
    REQUIRE(text.starts_with(begin));
    return text.substr(begin.size());
  }
}

}  // namespace

TEST_CASE("an EXR keeps every bit, of one and three channels, at any size") {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {3, 40}, {16384, 1}, {1, 20000}}) {
    for (const int channels : {1, 3}) {
      Image image(width, height, channels);
      for (size_t i = 0; i < image.sample_count(); ++i) image.samples()[i] = float(i) * 1.7f - 30;
      image.samples()[0] = std::numeric_limits<float>::quiet_NaN();
      image.samples().back() = -std::numeric_limits<float>::infinity();
      write_image(folder / "a.exr", image);
      const Image read = read_image(folder / "a.exr");
      REQUIRE(read.same_size(image));
      CHECK(std::ranges::equal(read.samples(), image.samples(), [](float a, float b) {
        return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
      }));
    }
  }
  CHECK(folder.names() == std::set<std::string>{"a.exr"});
}

TEST_CASE("half channels have a half's precision, and finite values stay finite") {
  const TemporaryFolder folder;
  Image image(4, 2, 4);
  for (size_t i = 0; i < image.sample_count(); ++i) image.samples()[i] = float(i) / 7;
  image.samples()[0] = 1e9f;
  image.samples()[1] = -1e9f;
  image.samples()[2] = std::numeric_limits<float>::infinity();
  image.samples()[3] = 1e9f;
  ImageWriter writer(folder / "a.exr", 4, 2, {{"R", true}, {"G", true}, {"B", true}, {"depth.Z"}});
  writer.write(image);
  writer.finish();
  const Image color = read_image(folder / "a.exr"), depth = read_image(folder / "a.exr", "depth");
  CHECK(color.pixel(0, 0)[0] == 65504);
  CHECK(color.pixel(0, 0)[1] == -65504);
  CHECK(std::isinf(color.pixel(0, 0)[2]));
  CHECK(depth.pixel(0, 0)[0] == 1e9f);
  for (int y = 0; y < 2; ++y)
    for (int x = y == 0; x < 4; ++x) {
      for (int c = 0; c < 3; ++c)
        CHECK(double(color.pixel(x, y)[c]) == doctest::Approx(double(image.pixel(x, y)[c])).epsilon(1e-3));
      CHECK(*depth.pixel(x, y) == image.pixel(x, y)[3]);
    }
}

TEST_CASE("every EXR compression, tiles and mipmaps are read") {
  for (const char* name : {"plain", "rle", "zips", "zip", "piz", "tiled"}) {
    CAPTURE(name);
    CHECK(holds(read_image(corpus + name + ".exr"), {0, 1, 2}));
  }
  CHECK(holds(read_image(corpus + "pxr24.exr"), {0, 1, 2}));
  for (const char* name : {"b44", "b44a", "dwaa", "dwab"}) {
    CAPTURE(name);
    CHECK(holds(read_image(corpus + name + ".exr"), {0, 1, 2}, 4));
  }
  CHECK(holds(read_image(corpus + "grey.exr"), {0}));
}

TEST_CASE("the picture is the display window: 0 around the data, and cropped outside") {
  const TemporaryFolder folder;
  Image image(3, 2, 1);
  for (size_t i = 0; i < image.sample_count(); ++i) image.samples()[i] = float(i) + 1;
  write_image(folder / "a.exr", image);
  const std::string whole = read_file(folder / "a.exr");
  const auto in_window = [&](std::array<int32_t, 4> window) {  // left, top, right, bottom; the data: 0 0 2 1
    const std::string attribute("displayWindow\0box2i\0\x10\0\0\0", 24);
    const size_t at = whole.find(attribute);
    REQUIRE(at != std::string::npos);
    const std::string bytes(reinterpret_cast<const char*>(window.data()), 16);
    write_file_atomically(folder / "b.exr", std::string(whole).replace(at + attribute.size(), 16, bytes));
    return read_image(folder / "b.exr");
  };
  CHECK(in_window({0, 0, 2, 1}).samples() == image.samples());
  CHECK(in_window({-1, 0, 1, 2}).samples() == std::vector<float>{0, 1, 2, 0, 4, 5, 0, 0, 0});
  CHECK(in_window({5, 5, 5, 5}).samples() == std::vector<float>{0});
  CHECK_THROWS_AS(in_window({0, 0, 100000, 0}), Error);
  CHECK_THROWS_AS(in_window({0, 0, 60000, 60000}), Error);
}

TEST_CASE("layers are chosen by name, and parts are layers") {
  const std::string layers = corpus + "layers.exr", parts = corpus + "parts.exr";
  CHECK(holds(read_image(layers), {0, 1, 2}));
  CHECK(holds(read_image(layers, "depth"), {4}));
  CHECK(holds(read_image(layers, "normal"), {5, 6, 7}));
  CHECK(holds(read_image(layers, "uv"), {8, 9, -1}));
  CHECK(holds(read_image(layers, "id"), {10}, 0.75f));  // whole numbers
  CHECK(holds(read_image(parts), {0, 1, 2}));
  CHECK(holds(read_image(parts, "beauty"), {0, 1, 2}));
  CHECK(holds(read_image(parts, "normal"), {0, 1, 2}));
  CHECK(holds(read_image(parts, "depth"), {0}));
  CHECK(holds(read_image(corpus + "one_layer.exr"), {0, 1, 2}));
  CHECK(holds(read_image(corpus + "one_layer.exr", "beauty"), {0, 1, 2}));
}

TEST_CASE("a header whose attributes or channels give the numbers another meaning causes a warning") {
  const TemporaryFolder folder;
  const auto warnings_of = [&](const std::string& bytes) {
    write_text(folder / "a.exr", bytes);
    std::vector<std::string> warnings;
    read_image(folder / "a.exr", "", warnings);
    return warnings;
  };
  const std::string plain = read_text(corpus + "zip.exr");
  CHECK(warnings_of(plain).empty());
  // Adds an attribute to the header; the offsets of the blocks behind it grow.
  const auto with = [&](const std::string& name, const std::string& type, const std::string& value) {
    const std::string added = name + '\0' + type + '\0' + char(value.size()) + std::string(3, '\0') + value;
    std::string bytes = plain;
    bytes.insert(8, added);
    const size_t last = bytes.find(std::string("screenWindowWidth") + '\0' + "float");
    REQUIRE(last != std::string::npos);
    const size_t table = last + 17 + 1 + 5 + 1 + 4 + 4 + 1;
    uint64_t first = 0;
    std::memcpy(&first, bytes.data() + table, sizeof first);
    for (size_t at = table; at < size_t(first) + added.size(); at += sizeof(uint64_t)) {
      uint64_t offset = 0;
      std::memcpy(&offset, bytes.data() + at, sizeof offset);
      offset += added.size();
      std::memcpy(bytes.data() + at, &offset, sizeof offset);
    }
    return bytes;
  };
  CHECK(warnings_of(with("whiteLuminance", "float", std::string(4, '\0'))).size() == 1);
  CHECK(warnings_of(with("colorInteropID", "string", "lin_ap0_scene")).size() == 1);
  CHECK(warnings_of(with("oiio:ColorSpace", "string", "lin_rec709")).empty());

  for (const std::string channel : {"Z", "Y"}) {
    ImageWriter writer(folder / "z.exr", 2, 2, std::vector<ExrChannel>{{channel, false}});
    writer.write(Image(2, 2, 1));
    writer.finish();
    CHECK(warnings_of(read_text(folder / "z.exr")).size() == size_t(channel == "Z"));
  }
  std::string without = plain;
  without.replace(without.find("displayWindow"), 13, "displayWindoW");
  write_text(folder / "a.exr", without);
  CHECK(refusal_of(folder / "a.exr") ==
        "its header is damaged, lacks a window or channels, or ends too early");
}

TEST_CASE("files that are no pictures are refused, each with a specific message") {
  CHECK(refusal_of(corpus + "layers.exr", "nrmal") ==
        "it has no layer 'nrmal'; its layers are depth, id, normal, uv");
  CHECK(refusal_of(corpus + "grey.exr", "id") == "it has no layer 'id'");
  CHECK(refusal_of(corpus + "only_layers.exr") == "it has several layers; name one of depth, id");
  CHECK(refusal_of(corpus + "lacks_green.exr") == "it lacks the channel G");
  CHECK(refusal_of(corpus + "many.exr") == "a picture must have one to three channels, not 4");
  CHECK(refusal_of(corpus + "deep.exr") == "it contains deep data");
  CHECK(refusal_of(corpus + "chroma.exr") == "it contains luminance and chroma, not red, green and blue");
  CHECK(refusal_of(corpus + "subsampled.exr") == "its channel B is subsampled");
}

TEST_CASE("a file that ends early, or claims more than it holds, is refused") {
  const TemporaryFolder folder;
  const std::string file = folder / "a.exr";
  for (const char* name : {"zip", "parts", "tiled", "piz"}) {
    CAPTURE(name);
    const std::string whole = read_text(corpus + name + ".exr");
    for (const size_t length : {size_t{0}, size_t{3}, size_t{8}, size_t{100}, whole.size() / 2}) {
      CAPTURE(length);
      write_text(file, whole.substr(0, length));
      CHECK(refusal_of(file) != "");
    }
  }
  write_text(file,
             read_text(corpus + "zip.exr").substr(0, std::filesystem::file_size(corpus + "zip.exr") - 1));
  CHECK(refusal_of(file) != "");
  // The windows' far corners.
  std::string huge = read_text(corpus + "zip.exr");
  const std::string window = std::string("dataWindow") + '\0' + "box2i" + '\0' + std::string("\x10\0\0\0", 4);
  const size_t at = huge.find(window);
  REQUIRE(at != std::string::npos);
  const auto with_corner = [&](int x, int y) {
    std::string changed = huge;
    for (int i = 0; i < 4; ++i) {
      changed[at + window.size() + 8 + size_t(i)] = char(x >> 8 * i);
      changed[at + window.size() + 12 + size_t(i)] = char(y >> 8 * i);
    }
    return changed;
  };
  for (const std::pair<int, int>& corner :
       {std::pair{16383, 16383}, {65535, 65535}, {0x7fffffff, 0x7fffffff}, {8, 0x7ffffffe}, {-2, 4}}) {
    CAPTURE(corner.first);
    write_text(file, with_corner(corner.first, corner.second));
    CHECK(refusal_of(file) != "");
  }
}
