// The simulated device takes each freedom that Vulkan leaves to it, unless the kernel forbids it.
#include <bit>
#include <cmath>
#include <limits>
#include <spirv-tools/libspirv.hpp>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// A kernel that computes `expression` from the floats a, b and c, which are the vector v too.
std::vector<uint32_t> kernel_of(const std::string& expression, const gpu::KernelOptions& options) {
  const gpu::SourceProvider shaders = [&](std::string_view path) {
    if (path != "test.comp.glsl") return project_shader(path);
    return std::optional<std::string>(
        "#version 450\n#include \"math/math.glsl\"\nlayout(local_size_x = 1) in;\n"
        "layout(std430, binding = 0) buffer Data { vec4 data[]; };\nvoid main() {\n"
        "  uint i = gl_GlobalInvocationID.x;\n  float a = data[i].x;\n  float b = data[i].y;\n"
        "  float c = data[i].z;\n  vec3 v = data[i].xyz;\n  data[i].w = " +
        expression + ";\n}\n");
  };
  return gpu::compile_kernel(gpu::read_shader(shaders, "test.comp.glsl"), "", options, no_cache).spirv;
}

// Its results for each triple, on a device that `worst` describes.
std::vector<float> computed(const std::string& expression, const std::vector<std::array<float, 3>>& triples,
                            const gpu::WorstDevice& worst, const std::optional<gpu::FloatModes>& policy) {
  const std::vector<uint32_t> spirv =
      kernel_of(expression, {.strict = policy, .worst = worst, .validate = true});
  std::string messages;
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
  tools.SetMessageConsumer(
      [&](spv_message_level_t, const char*, const spv_position_t&, const char* text) { messages += text; });
  CHECK_MESSAGE(tools.Validate(spirv), messages);

  gpu::Kernel kernel(device(), spirv, "worst device", no_cache);
  std::vector<float> data;
  for (const auto& [a, b, c] : triples) data.insert(data.end(), {a, b, c, 0.0f});
  gpu::Buffer buffer(device(), data.size() * sizeof(float), "data");
  buffer.upload_records(data);
  kernel.set_buffer(0, buffer);
  gpu::dispatch(device(), kernel, {}, {uint32_t(triples.size())});
  std::vector<float> results;
  const std::vector<float> after = buffer.read_records<float>(data.size());
  for (size_t i = 3; i < after.size(); i += 4) results.push_back(after[i]);
  return results;
}

const gpu::FloatModes no_modes{};
const float denormal = 1e-39f, no_number = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("a·b + c rounds once on the simulated device, unless the float policy forbids it") {
  const float a = 1.0f + 0x1p-12f, c = -(a * a);
  const std::vector<std::array<float, 3>> triple = {{a, a, c}};
  const float fused = std::fma(a, a, c);
  REQUIRE(fused != 0.0f);
  for (const char* expression : {"a * b + c", "c + a * b", "(v.xy * b + v.zz).x", "a * b - (-c)"}) {
    CAPTURE(expression);
    CHECK(computed(expression, triple, {.contraction = true}, {})[0] == fused);
    CHECK(computed(expression, triple, {}, {})[0] == 0.0f);
    CHECK(computed(expression, triple, {.contraction = true}, no_modes)[0] == 0.0f);
  }
  CHECK(computed("fma(a, b, c)", triple, {.contraction = true}, no_modes)[0] == fused);
}

TEST_CASE("denormals are zero on the simulated device, unless DenormPreserve forbids it") {
  const std::vector<std::array<float, 3>> triple = {{denormal, 0x1p30f, 0x1p-130f}};
  for (const char* expression :
       {"a * b", "c * 0.5", "a + c", "-a * b", "(v.xx * b).x", "sqrt(a)", "a > 0.0 ? 1.0 : 0.0"}) {
    CAPTURE(expression);
    CHECK(computed(expression, triple, {.denormals = true}, no_modes)[0] == 0.0f);
    CHECK(computed(expression, triple, {}, no_modes)[0] != 0.0f);
  }
  // Bits that are only moved stay.
  CHECK(computed("a", triple, {.denormals = true}, no_modes)[0] == denormal);
  std::vector<uint32_t> preserving = gpu::set_float_modes(
      word_kernel("data[i] = floatBitsToUint(uintBitsToFloat(data[i]) * 0.5);"), {true, false, false});
  CHECK(gpu::on_worst_device(preserving, {.denormals = true}) == preserving);
}

TEST_CASE(
    "min, max and clamp of a NaN return either operand on the simulated device; math.glsl's return the "
    "first") {
  const std::vector<std::array<float, 3>> triples = {
      {no_number, 1, 2}, {1, no_number, 2}, {0.0f, -0.0f, 2}, {3, 1, 2}};
  const auto same = [](float x, float y) {
    return std::isnan(x) ? std::isnan(y) : std::bit_cast<uint32_t>(x) == std::bit_cast<uint32_t>(y);
  };
  const auto differing = [&](const std::string& expression, const std::vector<float>& expected) {
    const std::vector<float> found = computed(expression, triples, {.nan = true}, no_modes);
    size_t count = 0;
    for (size_t i = 0; i < found.size(); ++i) count += !same(found[i], expected[i]);
    return count;
  };
  CHECK(differing("minimum(a, b)", {no_number, 1, 0.0f, 1}) == 0);
  CHECK(differing("maximum(a, b)", {no_number, 1, 0.0f, 3}) == 0);
  CHECK(differing("min(a, b)", {no_number, 1, 0.0f, 1}) == 3);
  CHECK(differing("max(v.xy, v.yx).x", {no_number, 1, 0.0f, 3}) == 3);
  CHECK(differing("clamp(a, b, c)", {1, 2, -0.0f, 2}) == 0);
}

TEST_CASE("operations whose results differ between devices are refused where division is corrected") {
  const auto refusal = [](const std::string& expression) {
    return error_of([&] { kernel_of(expression, {.strict = no_modes, .exact = true}); });
  };
  const std::pair<const char*, const char*> refused[] = {{"dot(v, v)", "dot"},
                                                         {"mod(a, b)", "mod"},
                                                         {"normalize(v).x", "normalize"},
                                                         {"fma(a, b, c)", "fma"},
                                                         {"min(a, b)", "min"},
                                                         {"max(v, v.zxy).x", "max"},
                                                         {"clamp(a, b, c)", "clamp"},
                                                         {"exp(a)", "exp"},
                                                         {"mix(a, b, c)", "mix"},
                                                         {"(mat3(a) * v).x", "a product of matrices"}};
  for (const auto& each : refused) {
    const std::string expression = each.first, name = each.second;
    CAPTURE(expression);
    const auto [text, code] = refusal(expression);
    CHECK(code == ExitCode::bad_input);
    CHECK(contains(text, "a shader uses " + name + ", whose result differs between devices"));
  }
  CHECK(refusal("sqrt(a) / b + floor(abs(c)) * minimum(a, b)").first == "");
}
