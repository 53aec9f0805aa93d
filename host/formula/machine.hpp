// Runs a formula on the CPU. Nothing of it is machine code: an interpreter executes a list of instructions on
// a private file of numbers, so that no formula can reach anything else. Private to this layer.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host/formula/ir.hpp"

namespace eyeray::engine::formula {

class Machine {
 public:
  // `function`: of the program, of one vector; limit() must have found nothing.
  Machine(const ir::Program& program, uint32_t function);

  // Writes all numbers of the function's result for `input`. In float32 it uses the shaders' functions
  // (math/formula.glsl), so that the bits are a kernel's; in float64 those of C's library. False if counted
  // loops take more iterations than FORMULA_ITERATIONS. `iterations`, if given, grows by the number of
  // iterations. Thread-safe.
  bool run(std::span<const float> input, float* result, uint64_t* iterations = nullptr) const;
  bool run(std::span<const double> input, double* result, uint64_t* iterations = nullptr) const;
  // The result of a function without an input in float32, of any type.
  std::vector<uint32_t> bits() const;

 private:
  friend class Assembler;

  // Operations of instructions, beside ir::Op's.
  enum Control : uint16_t {
    jump = 256,
    jump_if,
    jump_unless,
    iterate,
    end,
    move_real,
    select_real,
    load_real,
    store_real,
    clear_real,
    copy_real
  };
  // Numbers are named by their position in the file of floats or in that of whole numbers and truths. An
  // array is `length` of them from `array` on.
  struct Code {
    uint16_t op;
    uint32_t to = 0;
    std::array<uint32_t, 3> from{};
    uint32_t array = 0, length = 0;
  };
  template <typename T>
  struct Files;

  template <typename T>
  bool run_as(std::span<const T> input, T* result, uint64_t* iterations) const;

  uint64_t id_;  // no other machine's
  std::vector<Code> code_;
  std::vector<float> reals_;  // constants, with which the file of floats begins
  std::vector<uint32_t> wholes_;
  size_t real_count_ = 0, whole_count_ = 0;
  uint32_t input_ = 0;  // the first of the input's floats
  uint32_t input_count_ = 0;
  std::vector<uint32_t> results_;
  bool gives_reals_ = true;
};

}  // namespace eyeray::engine::formula
