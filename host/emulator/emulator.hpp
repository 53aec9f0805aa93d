// Runs compute kernels from their SPIR-V, on the processor, and watches them.
//
// Floats are IEEE 754's, every operation is rounded to nearest, none is fused, and denormals are kept. Memory
// is that of buffers, the texels of images, push constants and the work group. Subgroups have a size of one's
// choice. An access out of bounds reads 0 and writes nothing. docs/emulator.md lists the supported SPIR-V.
//
// The invocations of a work group run together: they wait for each other where
// the kernel's structure lets them reconverge. Work groups run one after the other.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "host/emulator/finding.hpp"

namespace eyeray::engine::emulator {

struct Program;
struct Trace;

// The numbers of an image's texels.
struct Format {
  enum class Kind : uint8_t { real, natural, integer, unorm, snorm } kind = Kind::real;
  uint32_t components = 4;
  uint32_t bits = 32;  // 8, 16 or 32, of each component

  uint32_t bytes() const { return components * bits / 8; }
};

// An image of one level, or a texel buffer. Its texels follow each other, x first.
struct Image {
  std::array<uint32_t, 3> extent{1, 1, 1};  // texels; the layers of an array come after its other axes
  Format format{};
  std::span<std::byte> bytes{};
};

// The order in which work groups run, and in which the invocations of one execute an access to memory. Vulkan
// promises no order. A kernel whose results differ between the two depends on one.
enum class Order : uint8_t { ascending, descending };

// The data of a dispatch.
struct Work {
  std::map<uint32_t, std::span<std::byte>> buffers{};  // by binding; texel buffers may have texels of rgba32f
  std::map<uint32_t, Image> images{};                  // by binding; texel buffers of other formats, too
  std::span<const std::byte> push_constants{};
  uint32_t subgroup_size = 8;  // a power of two, at most 64
  Order order = Order::ascending;
  // Called now and then with the number of operations so far, of all invocations together. It may throw. The
  // message of an Error (timed_out) then gets the line that the kernel was at.
  std::function<void(uint64_t operations)> watch{};
  Findings* findings = nullptr;
  Trace* trace = nullptr;  // one invocation is traced (trace.hpp); it names its writers with findings alone
};

class Kernel {
 public:
  // `spirv` is valid: SPIRV-Tools' validator accepts it. `name` is for findings. Error (bad_input), with the
  // instruction, for SPIR-V that the emulator does not have.
  Kernel(std::span<const uint32_t> spirv, std::string name);
  ~Kernel();
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  const std::string& name() const { return name_; }
  // Runs this many work groups along each axis. Error (bad_input) for images with too few bytes, and for
  // calls that are too deep.
  void run(const Work& work, const std::array<uint32_t, 3>& groups) const;

 private:
  std::string name_;
  std::unique_ptr<const Program> program_;
};

}  // namespace eyeray::engine::emulator
