#include <fmt/format.h>

#include "host/core/error.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

void check_refused(const std::string& part, const std::string& body, const How& how) {
  CHECK_THROWS_WITH_AS(run(body, std::vector<uint32_t>(64), how), doctest::Contains(part.c_str()), Error);
}

}  // namespace

TEST_CASE("a kernel that needs more than the emulator has is refused, in one sentence") {
  check_refused("has at most 4096 invocations of a work group, and the kernel needs 8192", "data[i] = 1u;",
                {.declarations = "layout(local_size_y = 128) in;"});
  check_refused("words of values and variables of a work group",
                "uint list[1000000]; list[i] = 1u; data[i] = list[i + 1u];", {.local_size = 128});
  check_refused("has at most 1048576 words of memory of a work group, and the kernel needs 1200000",
                "a[i] = b[i];", {.declarations = "shared uint a[600000]; shared uint b[600000];"});
  check_refused("has arrays of at most 1048576 elements, not 2000000", "a[i] = 1u;",
                {.declarations = "shared uint a[2000000];"});
  std::string functions = "void f0() { data[0] = 1u; } ";
  for (int n = 1; n < 250; ++n) functions += fmt::format("void f{}() {{ f{}(); }} ", n, n - 1);
  check_refused("calls functions that call others, more than 200 deep", "f249();",
                {.local_size = 1, .declarations = functions});
}

TEST_CASE("the caller may stop a kernel, however long its single steps are") {
  uint64_t last = 0;
  const auto stop = [&](uint64_t operations) {
    last = operations;
    if (operations > uint64_t{1} << 23) throw Error(ExitCode::timed_out, "stopped");
  };
  const std::string text =
      "#version 450\nlayout(local_size_x = 64) in;\nlayout(binding = 0) buffer Data { uint data[]; };\n"
      "void main() { uint a[9999], b[9999]; for (uint k = 0u; k < 4000000000u; ++k) { a[k % 9u] = k; b = a; "
      "} "
      "data[0] = b[3]; }\n";
  const emulator::Kernel kernel(compile(text), "kernel");
  CHECK_THROWS_WITH_AS(kernel.run({.watch = stop}, {1, 1, 1}),
                       doctest::Contains("stopped; kernel 'kernel' was at kernel.comp.glsl:4 ("), Error);
  CHECK(last < uint64_t{1} << 25);
}

TEST_CASE("the first thousand findings are kept") {
  emulator::Findings findings;
  for (int n = 0; n < 1500; ++n) findings.add({.location = std::to_string(n)});
  findings.add({.location = "7"});
  CHECK(findings.all().size() == 1000);
  CHECK(findings.all().back().count == 1);
}
