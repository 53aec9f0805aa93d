#include <ctime>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// Processor seconds that a million invocations of some 200 instructions take.
double seconds_of(const std::string& body, emulator::Findings* findings) {
  const std::string text =
      "#version 450\nlayout(local_size_x = 64) in;\nshared uint list[64];\n"
      "layout(binding = 0) buffer Data { uint data[]; };\nlayout(binding = 1) buffer Results { uint "
      "results[]; };\n"
      "void main() { const uint i = gl_GlobalInvocationID.x, l = gl_LocalInvocationIndex; " +
      body + " }\n";
  const emulator::Kernel kernel(compile(text), "kernel");
  std::vector<uint32_t> data(1000000), results(1000000);
  const std::clock_t start = std::clock();
  kernel.run({.buffers = {{0, std::as_writable_bytes(std::span(data))},
                          {1, std::as_writable_bytes(std::span(results))}},
              .findings = findings},
             {1000000 / 64, 1, 1});
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

TEST_SUITE("long") {
  TEST_CASE("a million invocations of 200 instructions take 10 seconds with checks, and 4 without") {
    for (const char* const body : {"float x = float(i) * 1e-6, y = x; for (uint k = 0u; k < 9u; ++k) { y = y "
                                   "* x + 0.5; x = fract(x * 1.7 + y); "
                                   "uint b = floatBitsToUint(x); b ^= b >> 3; x += float(b & 255u) * 0.001; "
                                   "} results[i] = uint(x * 1000.0);",
                                   "uint s = 0u; for (uint k = 0u; k < 13u; ++k) s += data[(i + k * 7919u) % "
                                   "1000000u] ^ k; results[i] = s;",
                                   "list[l] = data[i]; barrier(); uint s = 0u; for (uint k = 0u; k < 13u; "
                                   "++k) s += list[(l + k) & 63u] * k; "
                                   "results[i] = s;"}) {
      emulator::Findings findings;
      const double checked = seconds_of(body, &findings), unchecked = seconds_of(body, nullptr);
      MESSAGE(std::string(body), ": ", checked, " s with checks, ", unchecked, " s without");
      CHECK(checked < 10);
      CHECK(unchecked < 4);
      CHECK(findings.all().empty());
    }
  }
}
