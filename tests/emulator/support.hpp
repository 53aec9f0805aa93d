// Kernels in GLSL, run by the emulator.
#pragma once

#include <doctest/doctest.h>

#include <bit>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "host/emulator/emulator.hpp"
#include "host/gpu/shader_compiler.hpp"

namespace eyeray::engine::test {

inline std::vector<uint32_t> compile(const std::string& text) {
  return gpu::compile_shader({"kernel.comp.glsl", {{"kernel.comp.glsl", text}}}, "", gpu::Lines::kept).spirv;
}

// The buffer of a kernel with this body, and the findings. The body is line 5 of its text, and may use
// subgroups.
struct Ran {
  std::vector<uint32_t> data;
  std::vector<emulator::Finding> findings;
  std::map<uint32_t, std::vector<uint32_t>> more{};  // the further buffers, afterwards

  float real(size_t i) const { return std::bit_cast<float>(data[i]); }
  // The findings, a line each.
  std::string found() const {
    std::string text;
    for (const emulator::Finding& each : findings) text += emulator::describe(each) + "\n";
    return text;
  }
};

struct How {
  uint32_t local_size = 64;
  uint32_t groups = 1;
  uint32_t subgroup_size = 8;
  std::string declarations{};
  std::map<uint32_t, std::vector<uint32_t>> more{};  // further buffers, by binding
  std::map<uint32_t, emulator::Image> images{};
  emulator::Order order = emulator::Order::ascending;
};

inline Ran run(const std::string& body, std::vector<uint32_t> data, const How& how = {}) {
  const std::string text =
      "#version 450\n#extension GL_KHR_shader_subgroup_basic : require\n"
      "layout(local_size_x = " +
      std::to_string(how.local_size) +
      ") in;\n"
      "layout(std430, binding = 0) buffer Data { uint data[]; }; " +
      how.declarations + "\n" + "void main() { const uint i = gl_GlobalInvocationID.x; " + body + " }\n";
  const emulator::Kernel kernel(compile(text), "kernel");
  emulator::Findings findings;
  std::map<uint32_t, std::vector<uint32_t>> more = how.more;
  emulator::Work work{.buffers = {{0, std::as_writable_bytes(std::span(data))}},
                      .images = how.images,
                      .subgroup_size = how.subgroup_size,
                      .order = how.order,
                      .findings = &findings};
  for (auto& [binding, words] : more) work.buffers[binding] = std::as_writable_bytes(std::span(words));
  kernel.run(work, {how.groups, 1, 1});
  return {std::move(data), findings.all(), std::move(more)};
}

}  // namespace eyeray::engine::test
