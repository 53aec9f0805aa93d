// Runs compute kernels from their SPIR-V, on the processor, and watches them.
//
// Numbers have 32 bits. Floats are IEEE 754's, every operation is rounded to nearest, none is fused, and
// denormals are kept. Memory is that of storage, uniform and texel buffers, push constants and the work group.
// Subgroups have a size of one's choice. An access out of bounds reads 0 and writes nothing.
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

// The data of a dispatch.
struct Work {
  std::map<uint32_t, std::span<std::byte>> buffers{};  // by binding
  std::span<const std::byte> push_constants{};
  uint32_t subgroup_size = 8;  // a power of two, at most 64
  // Called now and then with the number of operations so far, of all invocations together. It may throw.
  std::function<void(uint64_t operations)> watch{};
  Findings* findings = nullptr;
};

class Kernel {
 public:
  // `name` is for findings. Error (bad_input), with the instruction, for SPIR-V that the emulator does not
  // have.
  Kernel(std::span<const uint32_t> spirv, std::string name);
  ~Kernel();
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  const std::string& name() const { return name_; }
  // Runs this many work groups along each axis.
  void run(const Work& work, const std::array<uint32_t, 3>& groups) const;

 private:
  std::string name_;
  std::unique_ptr<const Program> program_;
};

}  // namespace eyeray::engine::emulator
