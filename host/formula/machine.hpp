// Runs a formula on the CPU, without making machine code: an interpreter executes a list of instructions on
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
  // `function`: index of a function of the program that takes one vector. limit() must have returned "".
  Machine(const ir::Program& program, uint32_t function);

  // Writes all numbers of the function's result for `input`. In float32 it uses the shaders' functions
  // (math/formula.glsl), so that the bits are those of kernels; in float64 the functions of C's library.
  // False if counted loops take more iterations than FORMULA_ITERATIONS. `iterations`, if given, grows by the
  // number of iterations. Thread-safe.
  bool run(std::span<const float> input, float* result, uint64_t* iterations = nullptr) const;
  bool run(std::span<const double> input, double* result, uint64_t* iterations = nullptr) const;
  // The bits of the result, of any type, of a function without input, computed in float32.
  std::vector<uint32_t> bits() const;

 private:
  friend class Assembler;

  // Operations of Code in addition to those of ir::Op.
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
  // An instruction. Numbers are named by their position in the file of floats or in that of whole numbers and
  // truths. An array is the `length` numbers from position `array` on.
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

  uint64_t id_;  // unique to this machine
  std::vector<Code> code_;
  std::vector<float> reals_;      // the constants at the start of the file of floats
  std::vector<uint32_t> wholes_;  // the constants at the start of the other file
  size_t real_count_ = 0, whole_count_ = 0;
  uint32_t input_ = 0;  // position of the input's first float
  uint32_t input_count_ = 0;
  std::vector<uint32_t> results_;
  bool gives_reals_ = true;
};

}  // namespace eyeray::engine::formula
