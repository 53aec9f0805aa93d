#include <array>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;
using Kind = emulator::Format::Kind;

namespace {

// An image and its bytes.
struct Picture {
  std::vector<uint32_t> words;
  emulator::Image image;

  Picture(std::array<uint32_t, 3> extent, emulator::Format format)
      : words((size_t{extent[0]} * extent[1] * extent[2] * format.bytes() + 3) / 4),
        image{extent, format, std::as_writable_bytes(std::span(words))} {}
};

Ran run_on(Picture& picture, const std::string& declaration, const std::string& body,
           uint32_t local_size = 8) {
  return run(body, std::vector<uint32_t>(64),
             {.local_size = local_size,
              .declarations = "layout(binding = 1) uniform " + declaration + " picture;",
              .images = {{1, picture.image}}});
}

}  // namespace

TEST_CASE("images are written and read texel by texel") {
  Picture picture({4, 2, 1}, {Kind::real, 4, 32});
  const Ran ran = run_on(picture, "layout(rgba32f) image2D",
                         "const ivec2 at = ivec2(i % 4u, i / 4u); imageStore(picture, at, vec4(at, i, 0.5)); "
                         "data[i] = uint(dot(imageLoad(picture, at), vec4(1, 10, 100, 2))); "
                         "data[8u + i] = uint(imageSize(picture).x * 10 + imageSize(picture).y);");
  CHECK(ran.found() == "");
  for (uint32_t i = 0; i < 8; ++i) {
    CHECK(ran.data[i] == i % 4 + i / 4 * 10 + i * 100 + 1);
    CHECK(ran.data[8 + i] == 42);
    CHECK(std::bit_cast<float>(picture.words[4 * i + 2]) == float(i));
  }
}

TEST_CASE("texels have their format's numbers") {
  const auto stored = [](const char* format, emulator::Format of, const char* value, const char* read) {
    Picture picture({8, 1, 1}, of);
    const std::string prefix = of.kind == Kind::natural ? "u" : of.kind == Kind::integer ? "i" : "";
    const Ran ran = run_on(picture, "layout(" + std::string(format) + ") " + prefix + "image1D",
                           std::string("imageStore(picture, int(i), ") + value + "); data[i] = " + read +
                               "(imageLoad(picture, int(i)).x); data[8u + i] = " + read +
                               "(imageLoad(picture, int(i)).w);");
    CHECK(ran.found() == "");
    return std::vector<uint32_t>{picture.words[0], ran.data[0], ran.data[8]};
  };
  const auto bits = [](float x) { return std::bit_cast<uint32_t>(x); };
  const char *of_float = "floatBitsToUint", *of_whole = "uint";
  CHECK(stored("rgba8", {Kind::unorm, 4, 8}, "vec4(0.5, -1, 2, 1)", of_float) ==
        std::vector{0xffff0080u, bits(128 / 255.0f), bits(1)});
  CHECK(stored("rgba8_snorm", {Kind::snorm, 4, 8}, "vec4(-1, 0.5, 2, -0.25)", of_float) ==
        std::vector{0xe07f4081u, bits(-1), bits(-32 / 127.0f)});
  CHECK(stored("r32f", {Kind::real, 1, 32}, "vec4(0.1)", of_float) ==
        std::vector{bits(0.1f), bits(0.1f), bits(1)});
  CHECK(stored("rg16f", {Kind::real, 2, 16}, "vec4(1, -2, 3, 4)", of_float) ==
        std::vector{0xc0003c00u, bits(1), bits(1)});
  CHECK(stored("r32ui", {Kind::natural, 1, 32}, "uvec4(7)", of_whole) == std::vector{7u, 7u, 1u});
  CHECK(stored("rgba8i", {Kind::integer, 4, 8}, "ivec4(-3, 1, 2, -4)", of_whole) ==
        std::vector{0xfc0201fdu, uint32_t(-3), uint32_t(-4)});
}

TEST_CASE("images of three dimensions, arrays, texel buffers and sampled images have texels too") {
  Picture picture({2, 3, 4}, {Kind::natural, 1, 32});
  for (uint32_t i = 0; i < 24; ++i) picture.words[i] = i;
  const std::string texel = "const ivec3 at = ivec3(i % 2u, i / 2u % 3u, i / 6u); data[i] = ";
  for (const char* const kind : {"layout(r32ui) uimage3D", "layout(r32ui) uimage2DArray"})
    CHECK(run_on(picture, kind, texel + "imageLoad(picture, at).x;", 24).data[17] == 17);
  const Ran ran =
      run_on(picture, "usampler3D",
             texel +
                 "texelFetch(picture, at, 0).x + uint(textureSize(picture, 0).z) * 100u; "
                 "if (at == ivec3(0)) data[40] = texelFetchOffset(picture, at, 0, ivec3(1, 2, 3)).x;",
             24);
  CHECK(ran.found() == "");
  CHECK(ran.data[17] == 417);
  CHECK(ran.data[40] == 23);
  CHECK(run_on(picture, "usampler2DArray",
               "data[i] = texelFetchOffset(picture, ivec3(0, 1, 2), 0, ivec2(1, 1)).x;", 1)
            .data[0] == 17);
  Picture line({8, 1, 1}, {Kind::unorm, 4, 8});
  line.words[3] = 0xff;
  CHECK(run_on(line, "samplerBuffer", "data[i] = uint(texelFetch(picture, int(i)).x * 9.0);").data[3] == 9);
}

TEST_CASE("atomics change texels") {
  Picture picture({4, 2, 1}, {Kind::natural, 1, 32});
  const Ran ran = run_on(
      picture, "layout(r32ui) uimage2D",
      "data[i] = imageAtomicAdd(picture, ivec2(i % 2u, 1), 5u); imageAtomicMax(picture, ivec2(3, 0), i);");
  CHECK(ran.found() == "");
  CHECK(picture.words == std::vector<uint32_t>{0, 0, 0, 7, 20, 20, 0, 0});
  CHECK(ran.data[6] == 15);
}

TEST_CASE("accesses to texels are watched") {
  Picture picture({4, 2, 1}, {Kind::real, 1, 32});
  const auto found = [&](const std::string& body) {
    return run_on(picture, "layout(r32f) image2D", body).found();
  };
  const auto check_contains = [&](const std::string& text, const std::string& part) {
    CAPTURE(text);
    CHECK(text.find(part) != std::string::npos);
    CHECK(text.find("kernel.comp.glsl:5 (") != std::string::npos);
  };
  check_contains(found("imageStore(picture, ivec2(i, 1), vec4(0));"),
                 "texel 4, 1 of 4, 2 in 'picture', in invocation 4");
  check_contains(found("data[i] = uint(imageLoad(picture, ivec2(-1, i)).x);"), "texel -1, 0 of 4, 2");
  check_contains(found("imageStore(picture, ivec2(i / 2u, 1), vec4(i));"),
                 "race: two invocations access texel 4 of 'picture'");
  check_contains(found("float x; imageStore(picture, ivec2(0, i), vec4(x));"), "not initialised");
  check_contains(found("imageStore(picture, ivec2(i % 4u, i / 4u), vec4(0.0 / float(i)));"),
                 "0 and 0 give NaN, which reaches 'picture'");
  Picture whole({4, 1, 1}, {Kind::natural, 1, 32});
  check_contains(run_on(whole, "layout(r32ui) uimage1D", "imageAtomicAdd(picture, int(i), 1u);").found(),
                 "index 4 of 4 in 'picture'");
  check_contains(run_on(whole, "usampler1D", "data[i] = texelFetch(picture, 0, int(i)).x;").found(),
                 "level 1 of 1 in 'picture'");
}
