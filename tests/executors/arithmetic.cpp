// The shaders use only the arithmetic that GPU and twin agree on to the last bit.
#include <set>

#include "host/gpu/float_policy.hpp"
#include "host/gpu/spirv_optimiser.hpp"
#include "host/spirv/words.hpp"
#include "tests/support/entries.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::records;

TEST_CASE("no entry contains an operation whose rounding is left to the driver" *
          doctest::test_suite("long")) {
  // GLSL.std.450: FAbs, Floor, Sqrt, and nothing else.
  const std::set<uint32_t> allowed_extended = {4, 8, 31};
  constexpr uint32_t op_ext_inst = 12;
  constexpr uint32_t op_dot = 148;
  test::Random random(1);
  Scene small = test::random_scene(random, 3);
  Scene large = test::random_scene(random, 3);
  const int cube = test::add(large, test::cube());
  for (const double x : {-3, 3}) test::add_instance(large, cube, 0, test::translation({x, 0, 0}));
  // Kernels with the scene compiled in, with shapes tested one by one, and with BVHs, for each way to keep a
  // stack.
  const struct {
    const Scene& scene;
    Specialisation specialisation;
  } kernels[] = {{small, {}},
                 {small, {.constants = false}},
                 {large, {.profile = {.texel_buffers = true, .shift_stack = true}}},
                 {large, {.profile = {.texel_buffers = false, .shift_stack = false}}}};
  for (const auto& [described, specialisation] : kernels) {
    for (const uint32_t integrator : {0u, 1u}) {
      PackedScene scene = pack::pack(described);
      CHECK(scene.has_bvh == (&described == &large));
      scene.frame.integrator = integrator;
      scene.frame.max_depth = 8;
      scene.media.push_back({});
      scene.lights.push_back({});
      scene.textures[0].kind = shader::TEXTURE_checker;
      scene.textures.emplace_back().kind = shader::TEXTURE_image;
      scene.texel_count = TEXELS_FIRST;
      for (const uint32_t material : {0u, 1u, 2u}) {
        scene.materials[0].kind = material;
        const std::vector<uint32_t> written =
            test::compile_entry("kernels/render.comp.glsl", scene, specialisation);
        const std::vector<uint32_t> optimised = gpu::optimise(gpu::decorate_no_contraction(written));
        CHECK(gpu::decorate_no_contraction(optimised) == optimised);  // the optimiser keeps all decorations
        for (const auto& spirv : {written, optimised}) {
          int instructions = 0;
          spirv::for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> instruction) {
            ++instructions;
            CHECK(opcode != op_dot);
            if (opcode == op_ext_inst) CHECK(allowed_extended.contains(instruction[4]));
          });
          CHECK(instructions > 1000);
        }
      }
    }
  }
}
