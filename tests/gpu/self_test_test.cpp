#include "support.hpp"
#include "tests/support/process.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The self-test's shader with one piece of its text replaced: a driver that computes wrong.
gpu::SourceProvider with_fault(const std::string& right, const std::string& wrong) {
  std::string text = project_shader("kernels/selftest.comp.glsl").value();
  const size_t at = text.find(right);
  REQUIRE(at != std::string::npos);
  text.replace(at, right.size(), wrong);
  return [text](std::string_view path) {
    return path == "kernels/selftest.comp.glsl" ? std::optional(text) : project_shader(path);
  };
}

}  // namespace

TEST_CASE("the self-test reports this device's properties") {
  const TemporaryFolder folder;
  const DiskCache cache(folder.path());
  gpu::self_test(device(), project_shader, cache);
  const gpu::DeviceFacts facts = gpu::self_test(device(), project_shader, cache);
  MESSAGE(device().info().name, ", ", device().info().driver_version, ": ", facts.loop_iterations,
          " iterations, denormals ", facts.denormals_kept, ", infinities ", facts.infinities_kept, ", exact ",
          facts.exact_arithmetic, ", warm in ", facts.seconds * 1e3, " ms");
  CHECK(facts.infinities_kept);
  if (device().info().driver_version.starts_with("Mesa 22.3") && device().info().driver == "llvmpipe") {
    CHECK(facts.loop_cap);
    CHECK(facts.loop_iterations == 65535);
    CHECK(facts.denormals_kept);
    CHECK(facts.exact_arithmetic);
  }
  // Both caches have an entry, and are used.
  CHECK(folder.names().size() == 2);
}

TEST_CASE("a driver that computes wrong is refused") {
  const auto refusal = [](const std::string& right, const std::string& wrong) {
    return error_of([&] { gpu::self_test(device(), with_fault(right, wrong), no_cache); });
  };
  const auto [text, code] = refusal("hash(i ^ inputs[i])", "hash(i + inputs[i])");
  CHECK(code == ExitCode::no_device);
  CHECK(contains(text, device().info().name));
  CHECK(contains(text, "computes wrong results: an integer hash"));
  CHECK(contains(refusal("inputs[count - 1u - i]", "inputs[count - 1u]").first,
                 "computes wrong results: an indexed load"));
  CHECK(contains(refusal("state * 1664525u", "state * 1664527u").first,
                 "computes wrong results: a loop's result"));
}

TEST_CASE("division as wrong as Vulkan allows is found, and corrected") {
  const gpu::DeviceFacts facts = gpu::self_test(device(), project_shader, no_cache, {.division = true});
  CHECK(!facts.exact_division);
  CHECK(facts.exact_arithmetic);
}

TEST_CASE("each freedom that Vulkan leaves to a device is measured, so that none passes as exact") {
  const auto facts = [](const gpu::WorstDevice& worst) {
    return gpu::self_test(device(), project_shader, no_cache, worst);
  };
  CHECK(facts({}).exact_arithmetic);
  // The float policy forbids it to round a·b + c once, so that it does not.
  CHECK(facts({.contraction = true}).exact_arithmetic);
  CHECK(facts({.nan = true}).exact_arithmetic);
  const gpu::DeviceFacts flushing = facts({.denormals = true});
  CHECK(!flushing.denormals_kept);
  CHECK(flushing.infinities_kept);
  CHECK(!flushing.exact_arithmetic);
  CHECK(flushing.exact_division);
  CHECK(!facts({true, true, true, true}).exact_arithmetic);
}

TEST_CASE("loose arithmetic is a fact, not a refusal") {
  const auto facts = [](const std::string& right, const std::string& wrong) {
    return gpu::self_test(device(), with_fault(right, wrong), no_cache);
  };
  CHECK(!facts("floatBitsToUint(a / b)", "floatBitsToUint(a * (1.0 / b))").exact_arithmetic);
  CHECK(!facts("floatBitsToUint(sqrt(abs(a)))", "floatBitsToUint(sqrt(abs(a))) ^ 1u").exact_arithmetic);
  CHECK(!facts("floatBitsToUint(a * b + c)", "floatBitsToUint(float(double(a) * double(b) + double(c)))")
             .exact_arithmetic);
  // Denormals, infinities, zeros of both signs and NaN.
  const gpu::DeviceFacts flushed =
      facts("floatBitsToUint(a - b)", "floatBitsToUint(a - b) * (abs(a - b) < 1.17549435e-38 ? 0u : 1u)");
  CHECK(!flushed.denormals_kept);
  CHECK(!flushed.exact_arithmetic);
  CHECK(flushed.infinities_kept);
  CHECK(!facts("floor(a)", "(abs(a) >= 1.17549435e-38 ? floor(a) : 0.0)").denormals_kept);
  CHECK(!facts("a < b ?", "a - b < -1.17549435e-38 ?").exact_arithmetic);
  const gpu::DeviceFacts finite =
      facts("floatBitsToUint(a + b)", "floatBitsToUint(isinf(a + b) ? 3.4e38 : a + b)");
  CHECK(!finite.infinities_kept);
  CHECK(!finite.exact_arithmetic);
  CHECK(finite.denormals_kept);
  CHECK(!facts("floatBitsToUint(a * b);", "floatBitsToUint(a * b == 0.0 ? 0.0 : a * b);").exact_arithmetic);
  CHECK(!facts("a != b", "a < b || a > b").exact_arithmetic);
  // A division that alone loses denormals is corrected.
  const gpu::DeviceFacts divided =
      facts("floatBitsToUint(a / b)", "floatBitsToUint(abs(a / b) < 1.17549435e-38 ? 0.0 : a / b)");
  CHECK(!divided.exact_division);
  CHECK(divided.denormals_kept);
  CHECK(facts("made < loop_iterations", "made < 1000u").loop_cap);
}
