// Random formulas in kernels and drivers, against the interpreter.
#include <cmath>
#include <cstring>

#include "host/executors/shader_files.hpp"
#include "host/formula/formula.hpp"
#include "host/gpu/command_list.hpp"
#include "host/gpu/kernel_compiler.hpp"
#include "host/gpu/self_test.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/entries.hpp"
#include "tests/support/random_formula.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

constexpr size_t points = 64;

uint32_t bits_of(float x) {
  // All NaN count as one value.
  return std::isnan(x) ? 0x7fc00000u : __builtin_bit_cast(uint32_t, x);
}

// The values of `functions`, expressions of p, at each point: by function, then by point.
std::vector<float> run(gpu::Device& device, const std::string& text,
                       const std::vector<std::string>& functions, const std::vector<glm::vec4>& positions) {
  std::string main =
      "#version 450\n#include \"math/formula.glsl\"\n"
      "uint formula_iterations = 0u;\n"
      "bool formula_iterates(uint iterations) { formula_iterations = formula_iterations + iterations; return "
      "formula_iterations <= "
      "FORMULA_ITERATIONS; }\n" +
      text +
      "layout(local_size_x = 64) in;\n"
      "layout(std430, set = 0, binding = 0) readonly buffer Positions { vec4 positions[]; };\n"
      "layout(std430, set = 0, binding = 1) buffer Values { float values[]; };\n"
      "void main() {\n  uint i = gl_GlobalInvocationID.x;\n  vec3 p = positions[i].xyz;\n";
  for (size_t n = 0; n < functions.size(); ++n)
    main += fmt::format("  formula_iterations = 0u;\n  values[{}u + i] = {};\n", n * points, functions[n]);
  ShaderFiles embedded({}, "");
  const auto read = [&](std::string_view name) -> std::optional<std::string> {
    return name == "formulas.comp" ? std::optional(main + "}\n") : embedded.read(name);
  };
  const DiskCache cache = DiskCache({});
  const std::vector<uint32_t> spirv =
      gpu::compile_kernel(gpu::read_shader(read, "formulas.comp"), "", {device.info().float_modes}, cache)
          .spirv;
  gpu::Kernel kernel(device, spirv, "formulas", cache);
  gpu::Buffer in(device, positions.size() * sizeof(glm::vec4), "positions"),
      out(device, functions.size() * points * 4, "values");
  in.upload_records(positions);
  kernel.set_buffer(0, in);
  kernel.set_buffer(1, out);
  gpu::dispatch(device, kernel, {}, {1, 1, 1});
  return out.read_records<float>(functions.size() * points);
}

std::vector<glm::vec4> random_positions(uint64_t seed) {
  test::Random random(seed);
  std::vector<glm::vec4> positions;
  for (size_t i = 0; i < points; ++i) {
    const Vec3 p = random.point(i % 8 == 0 ? 1e6 : 2);
    positions.push_back({float(p.x), float(p.y), float(p.z), 0});
  }
  return positions;
}

std::unique_ptr<formula::Formula> formula_of(const std::string& text) {
  try {
    return std::make_unique<formula::Formula>(formula::FormulaText{text, {"f.glsl", 1, 1}},
                                              std::vector<formula::FormulaParameter>(), "it");
  } catch (const InputError&) {
    return nullptr;
  }
}

// The interpreter's value; none if the formula does not end.
std::optional<float> value_at(const formula::Formula& formula, const glm::vec4& p) {
  try {
    return formula.value(std::array{p.x, p.y, p.z});
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

TEST_CASE("kernels of random formulas compute the interpreter's bits, wherever indices point") {
  gpu::Device device({});
  constexpr int in_a_kernel = 8;
  size_t compared = 0, different = 0;
  for (int batch = 0; batch < test::amount(4, 4, 4000); ++batch) {
    std::vector<std::unique_ptr<formula::Formula>> formulas;
    std::string text, first_text;
    std::vector<std::string> functions;
    for (int i = 0; i < in_a_kernel; ++i) {
      const uint64_t seed = test::seed() * 10'000'000 + uint64_t(batch * in_a_kernel + i);
      auto formula = formula_of(test::RandomFormula(seed, false).text());
      if (!formula) continue;
      const std::string name = fmt::format("f{}_", i);
      text += formula->kernel(name);
      functions.push_back(name + "f(p)");
      formulas.push_back(std::move(formula));
    }
    const std::vector<glm::vec4> positions = random_positions(uint64_t(batch));
    const std::vector<float> values = run(device, text, functions, positions);
    for (size_t n = 0; n < formulas.size(); ++n) {
      for (size_t i = 0; i < points; ++i) {
        const auto expected = value_at(*formulas[n], positions[i]);
        if (!expected) continue;
        ++compared;
        if (bits_of(values[n * points + i]) == bits_of(*expected)) continue;
        if (++different > 3) continue;
        MESSAGE("kernel ", values[n * points + i], ", interpreter ", *expected, " at ", positions[i].x, " ",
                positions[i].y, " ", positions[i].z, ":\n", formulas[n]->text().text);
      }
    }
  }
  MESSAGE(compared, " values compared");
  CHECK(compared > 1000);
  CHECK(different == 0);
}

TEST_CASE("formulas without undefined operations have the values that a driver computes from their text") {
  gpu::Device device({});
  size_t compared = 0, different = 0;
  for (int k = 0; k < test::amount(12, 12, 3000); ++k) {
    const std::string text = test::RandomFormula(test::seed() * 10'000'000 + uint64_t(k), true).text();
    const auto formula = formula_of(text);
    if (!formula) continue;
    const std::vector<glm::vec4> positions = random_positions(uint64_t(k));
    const std::vector<float> values = run(device, text, {"f(p)"}, positions);
    for (size_t i = 0; i < points; ++i) {
      const auto expected = value_at(*formula, positions[i]);
      if (!expected || !std::isfinite(*expected) || !std::isfinite(values[i])) continue;
      ++compared;
      if (bits_of(values[i]) == bits_of(*expected)) continue;
      if (++different > 3) continue;
      MESSAGE("driver ", values[i], ", interpreter ", *expected, " at ", positions[i].x, " ", positions[i].y,
              " ", positions[i].z, ":\n", text);
    }
  }
  MESSAGE(compared, " values compared");
  CHECK(compared > 300);
  CHECK(different == 0);
}
