// The files of a kernel that a user brings: GLSL, HLSL or SPIR-V.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine::compute {

// True if a file of that name is a kernel by itself: .comp, .glsl, .hlsl or .spv.
bool is_kernel_source(const std::filesystem::path& file);

struct KernelSource {
  std::filesystem::path file;          // .hlsl is HLSL, .spv SPIR-V, and any other file GLSL
  std::string entry{};                 // empty: "main", or the only one of SPIR-V
  std::vector<std::string> defines{};  // "NAME" or "NAME=VALUE"
  std::vector<std::filesystem::path> include_folders{};  // searched after the kernel's own folder
};

struct LoadedKernel {
  std::vector<uint32_t> spirv;  // valid, with one entry point; it may have specialization constants
  std::vector<Diagnostic> warnings;
};

// Reads, compiles and validates a kernel. InputError with every error of the compiler, at its file, line and
// column. Error (file_io) if the file cannot be read, (bad_input) if its SPIR-V is not valid.
LoadedKernel load_kernel(const KernelSource& source);

}  // namespace eyeray::engine::compute
