#include <cmath>

#include "host/core/error.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("the emulator computes what C++ computes") {
  std::vector<uint32_t> data;
  for (int i = 0; i < 64; ++i) data.push_back(std::bit_cast<uint32_t>(0.37f * float(i) - 9));
  SUBCASE("floats") {
    const Ran ran =
        run("float x = uintBitsToFloat(data[i]); data[i] = floatBitsToUint(sqrt(abs(x * x - 3.0)) / (x + "
            "0.01) - floor(x));",
            data);
    CHECK(ran.found() == "");
    for (int i = 0; i < 64; ++i) {
      const float x = 0.37f * float(i) - 9;
      CHECK(ran.real(size_t(i)) == std::sqrt(std::fabs(x * x - 3.0f)) / (x + 0.01f) - std::floor(x));
    }
  }
  SUBCASE("whole numbers, signed and unsigned") {
    const Ran ran =
        run("int x = int(i) - 30; data[i] = uint(x / 7 * 1000 + x % 7 * 10 + (x >> 2)) ^ (i << 20) ^ "
            "bitCount(i * 77u);",
            data);
    CHECK(ran.found() == "");
    for (int i = 0; i < 64; ++i) {
      const int x = i - 30;
      // GLSL leaves % of negative numbers undefined; SPIR-V's OpSMod has the divisor's sign.
      const int rest = (x % 7 + 7) % 7;
      CHECK(ran.data[size_t(i)] == (uint32_t(x / 7 * 1000 + rest * 10 + (x >> 2)) ^ uint32_t(i) << 20 ^
                                    uint32_t(std::popcount(uint32_t(i) * 77u))));
    }
  }
  SUBCASE("vectors and matrices") {
    const Ran ran =
        run("mat3 m = mat3(1, 2, 3, 4, 5, 6, 7, 8, 10); vec3 v = m * vec3(i, 1, 2) + vec3(1, 0, 0) * m; "
            "data[i] = floatBitsToUint(dot(v.zyx, vec3(1, 10, 100)) + transpose(m)[0][2] + determinant(m));",
            data);
    CHECK(ran.found() == "");
    for (int i = 0; i < 64; ++i) {
      const float x = float(i), v[3] = {x + 4 + 14 + 1, 2 * x + 5 + 16 + 4, 3 * x + 6 + 20 + 7};
      CHECK(ran.real(size_t(i)) == v[2] + 10 * v[1] + 100 * v[0] + 7 - 3);
    }
  }
  SUBCASE("functions, loops, switches and arrays") {
    const Ran ran =
        run("uint sum = 0u; uint list[4] = uint[4](3u, 5u, 7u, 11u); for (uint k = 0u; k < i; ++k) { if (k % "
            "5u == 3u) continue; if (k > 40u) break; "
            "switch (k % 4u) { case 0u: sum += 1u; case 1u: sum += list[k % 4u]; break; case 2u: sum ^= k; "
            "break; default: twice(sum); } } data[i] = sum;",
            data, {.declarations = "void twice(inout uint x) { x *= 2u; if (x > 1000u) return; x += 1u; }"});
    CHECK(ran.found() == "");
    for (uint32_t i = 0; i < 64; ++i) {
      uint32_t sum = 0;
      const uint32_t list[4] = {3, 5, 7, 11};
      for (uint32_t k = 0; k < i; ++k) {
        if (k % 5 == 3) continue;
        if (k > 40) break;
        if (k % 4 == 0) sum += 1;
        if (k % 4 <= 1) sum += list[k % 4];
        if (k % 4 == 2) sum ^= k;
        if (k % 4 == 3) sum = sum * 2 > 1000 ? sum * 2 : sum * 2 + 1;
      }
      CHECK(ran.data[i] == sum);
    }
  }
}

TEST_CASE("functions with two results, and inverse matrices") {
  const Ran ran =
      run("float x = (float(i) - 9.3) * 7.1, whole; int e; float part = modf(x, whole), m = frexp(x, e); "
          "data[i] = floatBitsToUint(part * 1000.0 + whole + m); data[64u + i] = floatBitsToUint(ldexp(m, e "
          "+ 3)); "
          "mat3 a = mat3(2, 1, 0, float(i) + 20.0, 3, 1, 5, 0, 1); mat3 b = inverse(a) * a - mat3(1); "
          "data[128u + i] = floatBitsToUint(max(max(abs(b[0][0]), abs(b[1][0])), max(abs(b[2][1]), "
          "abs(b[0][2]))));",
          std::vector<uint32_t>(192));
  CHECK(ran.found() == "");
  for (size_t i = 0; i < 64; ++i) {
    const float x = (float(i) - 9.3f) * 7.1f;
    int exponent = 0;
    const float mantissa = std::frexp(x, &exponent);
    CHECK(ran.real(i) == (x - std::trunc(x)) * 1000.0f + std::trunc(x) + mantissa);
    CHECK(ran.real(64 + i) == x * 8);
    CHECK(ran.real(128 + i) < 1e-3f);
  }
}

TEST_CASE("subgroups combine and exchange the values of their active invocations") {
  for (const uint32_t size : {1u, 4u, 8u, 32u, 64u}) {
    CAPTURE(size);
    const Ran ran =
        run("uint sum = 0u; if (i % 3u == 0u) sum = subgroupAdd(i) + subgroupExclusiveAdd(1u) * 100000u; "
            "else sum = subgroupMax(i); "
            "uint other = subgroupShuffleXor(i, 1u); data[i] = sum * 2u + (subgroupAll(other < 64u) ? 1u : "
            "0u); data[64u + i] = other;",
            std::vector<uint32_t>(128),
            {.subgroup_size = size,
             .declarations = "\n#extension GL_KHR_shader_subgroup_arithmetic : require\n#extension "
                             "GL_KHR_shader_subgroup_shuffle : require\n"
                             "#extension GL_KHR_shader_subgroup_vote : require\n"});
    for (uint32_t i = 0; i < 64; ++i) {
      uint32_t sum = 0, before = 0, most = 0;
      for (uint32_t k = i / size * size; k < i / size * size + size; ++k) {
        if (k % 3 == 0)
          sum += k, before += k < i;
        else
          most = k;
      }
      if (size == 1) continue;  // the other one is in another subgroup
      CHECK(ran.data[i] == (i % 3 == 0 ? sum + before * 100000 : most) * 2 + 1);
      CHECK(ran.data[64 + i] == (i ^ 1));
    }
  }
}

TEST_CASE("subgroups have masks of their invocations") {
  const Ran ran = run(
      "data[i] = (gl_SubgroupLtMask.x ^ gl_SubgroupGtMask.x ^ gl_SubgroupEqMask.x) + "
      "(gl_SubgroupGeMask.x & gl_SubgroupLeMask.x) * 1000u;",
      std::vector<uint32_t>(64), {.declarations = "\n#extension GL_KHR_shader_subgroup_ballot : require\n"});
  for (uint32_t i = 0; i < 64; ++i) CHECK(ran.data[i] == 255 + (1000u << i % 8));
}

TEST_CASE("functions may have images as parameters") {
  std::vector<uint32_t> texels(16, 3), others(16, 5), written(16);
  const auto image = [](std::vector<uint32_t>& of) {
    return emulator::Image{
        {16, 1, 1}, {emulator::Format::Kind::natural, 1, 32}, std::as_writable_bytes(std::span(of))};
  };
  const How how{
      .local_size = 16,
      .declarations =
          "layout(binding = 1) uniform usampler1D a; layout(binding = 2) uniform usampler1D b; "
          "layout(binding = 3) writeonly uniform uimage1D c; "
          "uint texel(usampler1D from, int at) { if (at > 7) return 1u; return texelFetch(from, at, 0).x; } "
          "uint twice(usampler1D from, int at) { return texel(from, at) * 2u; } "
          "void put(writeonly uimage1D to, int at) { imageStore(to, at, uvec4(7)); }",
      .images = {{1, image(texels)}, {2, image(others)}, {3, image(written)}}};
  const Ran ran =
      run("data[i] = texel(a, int(i)) + twice(b, int(i)); put(c, int(i));", std::vector<uint32_t>(16), how);
  CHECK(ran.found() == "");
  for (uint32_t i = 0; i < 16; ++i) CHECK(ran.data[i] == (i > 7 ? 3 : 13));
  CHECK(written == std::vector<uint32_t>(16, 7));
  CHECK(run("put(c, int(i) / 2);", std::vector<uint32_t>(16), how).found().find("race") != std::string::npos);
}

TEST_CASE("work groups share memory, and wait for each other at barriers") {
  const Ran ran =
      run("const uint l = gl_LocalInvocationIndex; list[l] = data[i]; barrier(); "
          "for (uint step = 1u; step < 64u; step *= 2u) { uint x = l >= step ? list[l - step] : 0u; "
          "barrier(); list[l] += x; barrier(); } "
          "data[i] = list[l]; atomicAdd(data[128], 1u);",
          std::vector<uint32_t>(129, 3), {.groups = 2, .declarations = "shared uint list[64];"});
  CHECK(ran.found() == "");
  for (uint32_t i = 0; i < 128; ++i) CHECK(ran.data[i] == 3 * (i % 64 + 1));
  CHECK(ran.data[128] == 3 + 128);
}

TEST_CASE("the emulator refuses what it does not have, with the place") {
  const std::string text =
      "#version 450\nlayout(local_size_x = 1) in;\nlayout(binding = 0) uniform sampler2D "
      "picture;\nlayout(binding = 1) buffer B { vec4 b; };\nvoid main() { b = texture(picture, vec2(0)); }\n";
  CHECK_THROWS_WITH_AS(
      emulator::Kernel(compile(text), "k"),
      doctest::Contains("does not have the instruction kernel.comp.glsl:5 (OpImageSampleExplicitLod"), Error);
}
