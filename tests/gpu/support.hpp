// Common parts of the tests of host/gpu: kernels from text, and one device for all.
#pragma once

#include <string>
#include <vector>

#include "host/core/atomic_file.hpp"
#include "host/gpu/command_list.hpp"
#include "host/gpu/float_policy.hpp"
#include "host/gpu/kernel_compiler.hpp"
#include "host/gpu/rasterizer.hpp"
#include "host/gpu/self_test.hpp"
#include "host/gpu/shader_compiler.hpp"
#include "tests/support/doctest.hpp"

namespace eyeray::engine::test {

inline const DiskCache no_cache{{}};

// The device of most tests; making one costs 20 ms.
inline gpu::Device& device() {
  static gpu::Device device({});
  return device;
}

inline gpu::SourceProvider files(std::map<std::string, std::string> texts) {
  return [texts = std::move(texts)](std::string_view path) -> std::optional<std::string> {
    const auto found = texts.find(std::string(path));
    return found == texts.end() ? std::nullopt : std::optional(found->second);
  };
}

// The project's own shaders.
inline std::optional<std::string> project_shader(std::string_view path) {
  const std::filesystem::path file = "shaders/" + std::string(path);
  return std::filesystem::exists(file) ? std::optional(read_file(file)) : std::nullopt;
}

inline std::vector<uint32_t> compile(const std::string& text, const std::string& preamble = "") {
  return gpu::compile_shader(gpu::read_shader(files({{"test.comp.glsl", text}}), "test.comp.glsl"), preamble)
      .spirv;
}

// The project's own shaders for drawing.
inline gpu::RasterShaders raster_shaders() {
  const auto compiled = [](std::string_view entry) {
    return gpu::compile_shader(gpu::read_shader(project_shader, entry), "").spirv;
  };
  return {compiled("kernels/raster.vert.glsl"), compiled("kernels/raster.frag.glsl")};
}

// A kernel of one buffer of words, `data`, at binding 0.
inline std::vector<uint32_t> word_kernel(const std::string& body, int local_size = 64) {
  return compile("#version 450\nlayout(local_size_x = " + std::to_string(local_size) +
                 ") in;\nlayout(std430, binding = 0) buffer Data { uint data[]; };\nvoid main() {\n"
                 "  uint i = gl_GlobalInvocationID.x;\n" +
                 body + "\n}\n");
}

// The text and the code of the Error that `work` throws; the text is "" if it throws none.
template <typename Work>
std::pair<std::string, ExitCode> error_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return {error.what(), error.code()};
  }
  return {"", ExitCode::ok};
}

inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

}  // namespace eyeray::engine::test
