// Options for making executors.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "host/executors/profile_options.hpp"
#include "host/gpu/worst_device.hpp"
#include "host/pack/options.hpp"
#include "host/scene/photons.hpp"

namespace eyeray::engine::executors {

class OpenDevice;
class Tunables;

// The way that kernels divide and take square roots: exactly where the device does not, as the device does,
// or exactly in any case.
enum class Division { automatic, own, exact };

struct GpuOptions {
  std::string device = "auto";              // auto | cpu | gpu | INDEX | part of a NAME
  std::shared_ptr<OpenDevice> open_device;  // used as it is, and left open; null: the executor opens one
  std::string validation;                   // "", "core" or "sync"
  double timeout_seconds = 60;              // the longest wait for one dispatch
  double least_compile_seconds = 0;  // the longest compilation of a kernel, if this exceeds timeout_seconds
  bool sets_environment = true;      // DeviceOptions::sets_environment
  bool wide_vectors = true;          // use them if the picture gains from them (trace_plan.hpp)
  ProfileOptions profile;
  bool fast_math = false;  // let the driver contract and re-associate
  Division division = Division::automatic;
  gpu::WorstDevice worst_device;       // for tests: KernelOptions::worst
  bool emulate = false;                // run kernels by the emulator, as the device would get them
  uint32_t emulated_subgroup = 0;      // DeviceOptions::emulated_subgroup
  bool validate_spirv = false;         // validate a kernel's SPIR-V before the driver gets it
  bool constants = true;               // compile the primitives of a small scene into the kernel
  bool formula_numbers = false;        // kernels load the numbers of formulas, and so suit other numbers too
  bool optimise = true;                // give the driver an optimised kernel
  bool examines_kernels = false;       // make every kernel at once, for ExecutorFacts::kernels
  std::shared_ptr<Tunables> tunables;  // shaders' constants that a person can move; null: none

  bool operator==(const GpuOptions&) const = default;
};

struct TwinOptions {
  bool compile = false;    // compile ExecutorOptions::shader_folder's files as C++ (twin_module.hpp)
  std::string sanitizers;  // for compiled modules, as -fsanitize takes them

  bool operator==(const TwinOptions&) const = default;
};

struct ExecutorOptions {
  std::filesystem::path shader_folder;  // laid over the embedded shaders, file by file; empty: none
  pack::PackOptions pack;               // the reference uses only `acceleration`
  bool ray_kinds = false;               // count reflected and refracted rays; the GPU does so on request
  bool search_cost = false;  // fill FirstHit::cost; the GPU does so on request, the reference never
  LeftOutPhotons left_out;   // photons that bring no light
  GpuOptions gpu;
  TwinOptions twin;

  bool operator==(const ExecutorOptions&) const = default;
};

// True if so many samples repay kernels that contain the scene. Kernels without it could serve the next scene
// too.
bool repay_kernels(int64_t samples);
// Options for successive scenes that differ by motion, each a picture of so many samples. Their BVHs are
// refitted where that suffices. The scenes share kernels unless the samples repay new ones.
ExecutorOptions for_frames(ExecutorOptions options, int64_t samples);

}  // namespace eyeray::engine::executors
