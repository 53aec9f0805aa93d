// The trace of one invocation.
#include "host/emulator/trace.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The trace as lines of text: "5: x = 1, list[1] is 2 of 3,0,0".
std::string traced(const std::vector<uint32_t>& spirv, emulator::Trace& trace) {
  const emulator::Kernel kernel(spirv, "kernel");
  emulator::Findings findings;
  std::array<uint32_t, 8> data{10, 11, 12, 13, 14, 15, 16, 17};
  kernel.run(
      {.buffers = {{0, std::as_writable_bytes(std::span(data))}}, .findings = &findings, .trace = &trace},
      {2, 1, 1});
  CHECK(findings.all().empty());
  std::string text;
  for (const emulator::TracedLine& line : trace.lines) {
    std::vector<std::string> values;
    for (const emulator::TracedValue& each : line.values) {
      const bool reads = each.kind == emulator::TracedValue::Kind::read;
      values.push_back(fmt::format("{}{}{}{}", each.name, reads ? " is " : " = ", each.value,
                                   each.writer ? fmt::format(" of {}", fmt::join(*each.writer, ",")) : ""));
    }
    text += fmt::format("{}: {}\n", line.line, fmt::join(values, ", "));
  }
  return text;
}

std::string kernel(const std::string& body) {
  return "#version 450\nlayout(local_size_x = 4) in;\n"
         "struct Pair { uint first; vec2 second; };\nshared Pair pairs[4];\n"
         "layout(std430, binding = 0) buffer Data { uint data[]; };\n"
         "void main() {\nconst uint i = gl_GlobalInvocationID.x, l = gl_LocalInvocationID.x;\n" +
         body + "}\n";
}

}  // namespace

TEST_CASE("a trace has every line that the invocation ran, with its values and their writers") {
  emulator::Trace trace{.invocation = {5, 0, 0}};
  const std::string text = traced(compile(kernel("pairs[l].first = 2 * data[i];\n"
                                                 "pairs[l].second = vec2(i, 0.5);\n"
                                                 "barrier();\n"
                                                 "uint sum = 0;\n"
                                                 "for (uint k = 0; k < 2; ++k)\n"
                                                 "  sum += pairs[(l + k) % 4].first;\n"
                                                 "if (l == 0)\n"
                                                 "  sum = 7;\n"
                                                 "data[i] = sum;\n")),
                                  trace);
  CHECK(text ==
        "7: i = 5, l = 1\n"
        "8: data[5] is 15, pairs[1].first = 30\n"
        "9: pairs[1].second = (5, 0.5)\n"
        "10:  = \n"
        "11: sum = 0\n"
        "12: k = 0,  = true\n"
        "13: pairs[1].first is 30, sum = 30\n"
        "12: k = 1,  = true\n"
        "13: pairs[2].first is 32 of 6,0,0, sum = 62\n"
        "12: k = 2,  = false\n"
        "14:  = false\n"
        "16: data[5] = 62\n");
  CHECK_FALSE(trace.cut);
  REQUIRE(trace.written.size() == 1);
  CHECK(trace.written.at({0, 20}).line == 16);
  CHECK(trace.names.contains("pairs"));
  CHECK(trace.names.contains("data"));
}

TEST_CASE("a trace follows one variable, in all lines that read or write it") {
  const std::vector<uint32_t> spirv =
      compile(kernel("uint a = data[i], b = a;\na += 1;\nb += a;\nbarrier();\ndata[i] = b;\n"));
  emulator::Trace of_a{.invocation = {2, 0, 0}, .follow = "a"};
  CHECK(traced(spirv, of_a) ==
        "8: data[2] is 12, a = 12, a is 12, b = 12\n9: a is 12, a = 13\n10: a is 13, b = 25\n");
  emulator::Trace of_data{.invocation = {2, 0, 0}, .follow = "data[2]"};
  CHECK(traced(spirv, of_data) == "8: data[2] is 12, a = 12, b = 12\n12: data[2] = 25\n");
  emulator::Trace of_other{.invocation = {2, 0, 0}, .follow = "data[1]"};
  CHECK(traced(spirv, of_other).empty());
}

TEST_CASE("a trace without lines has the instructions, and a long one ends") {
  std::vector<uint32_t> spirv =
      gpu::compile_shader({"k.comp.glsl", {{"k.comp.glsl", kernel("data[i] = data[i] + 7;\n")}}}, "").spirv;
  emulator::Trace trace{.invocation = {1, 0, 0}};
  traced(spirv, trace);
  bool adds = false;
  for (const emulator::TracedLine& line : trace.lines)
    adds = adds || (line.instruction.starts_with("OpIAdd %") && line.values.at(0).value == "18");
  CHECK(adds);

  emulator::Trace endless{.invocation = {1, 0, 0}};
  traced(compile(kernel("uint n = 0;\nfor (uint k = 0; k < 20000; ++k)\n  n += k;\ndata[i] = n;\n")),
         endless);
  CHECK(endless.cut);
  CHECK(endless.lines.size() == emulator::most_traced_lines);
  CHECK(endless.written.at({0, 4}).line == 11);
}

TEST_CASE("a traced atomic shows the number before and after its own turn") {
  emulator::Trace trace{.invocation = {2, 0, 0}};
  const std::string text = traced(compile(kernel("uint before = atomicAdd(data[0], i + 1);\n")), trace);
  CHECK(text == "7: i = 2, l = 2\n8: data[0] is 13 of 1,0,0, data[0] = 16, before = 13\n");
}
