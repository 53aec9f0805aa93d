// A formula as a program over single numbers. It computes the same as the formula's SPIR-V, with nothing
// undefined left. Every executor runs it in its own arithmetic: the interpreter in float32 and float64,
// kernels as GLSL. Private to this layer.
//
// Whole numbers wrap around. A shift uses the last five bits of its distance. x / 0 and x % 0 are 0. Indices
// are clamped into their arrays. A float beyond int's or uint's range converts to the least int or to 0u.
// A variable that is read before it is written is 0.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <variant>
#include <vector>

namespace eyeray::engine::formula::ir {

// real: a float; whole: the 32 bits of an int or uint; truth: a bool.
enum class Type : uint8_t { real, whole, truth };

enum class Op : uint8_t {
  move,  // a number of any type
  // Operations on floats: C's operators, then the functions fn_… of shaders/math/formula.glsl.
  negate,
  add,
  subtract,
  multiply,
  divide,
  absolute,
  sign,
  floor,
  ceil,
  trunc,
  round,
  fract,
  sqrt,
  inversesqrt,
  radians,
  degrees,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  exp,
  log,
  exp2,
  log2,
  sinh,
  cosh,
  tanh,
  atan2,
  pow,
  min,
  max,
  mod,
  step,
  clamp,
  mix,
  smoothstep,
  // Comparisons of floats, which give a truth. NaN is neither less nor greater, and unequal to everything.
  less,
  less_equal,
  equal,
  // Operations on whole numbers. Signed ones are in two's complement.
  whole_negate,
  whole_add,
  whole_subtract,
  whole_multiply,
  signed_divide,
  unsigned_divide,
  signed_remainder,
  unsigned_remainder,
  signed_modulo,
  bit_and,
  bit_or,
  bit_xor,
  bit_not,
  shift_left,
  shift_right,
  signed_shift_right,
  whole_equal,
  signed_less,
  unsigned_less,
  clamp_index,  // clamps from 0, a signed number, into [0, from 1); from 1 is a constant
  // Conversions.
  from_signed,
  from_unsigned,
  to_signed,
  to_unsigned,
  // Truths.
  both,
  either,
  opposite,
  same,
  select,  // from 0 ? from 1 : from 2; the latter two are of any type
  // Memory. load: to = array[from 0]. store: array[from 0] = from 1. clear: sets all numbers of `array` to 0.
  // copy: copies all numbers of `other` to `array`.
  load,
  store,
  clear,
  copy,
};

// The index of a register of the function, or ~index of a constant of the program.
using Operand = int32_t;
// The index of an array of the function, or ~index of a table of the program.
using ArrayId = int32_t;

struct Instruction {
  Op op;
  Operand to = 0;
  std::array<Operand, 3> from{};
  ArrayId array = 0, other = 0;
};

// The position of a value: its numbers (of a matrix column by column), or an array that holds them.
struct Slot {
  std::vector<Operand> numbers{};
  bool is_array = false;
  ArrayId array = 0;
};

struct Statement;
using Block = std::vector<Statement>;

// A call copies its arguments in. It copies back the result, and each argument that the function writes to.
struct Call {
  uint32_t function;
  std::vector<Slot> arguments;
  Slot result;
};
struct Branch {
  Operand condition;
  Block yes, no;
};
// Repeats `body` and then `next` until a jump leaves the loop.
struct Loop {
  Block body, next;
  uint32_t iterations = 0;  // upper bound of iterations, if known and if they need no counting; else 0
  uint32_t weight = 0;      // weight of an iteration, if iterations are counted
};
// leave: leaves the innermost loop. next: goes to its next iteration. give_back: returns from the function.
enum class Jump : uint8_t { leave, next, give_back };

struct Statement {
  std::variant<Instruction, Call, Branch, Loop, Jump> what;
};

struct Array {
  Type type;
  uint32_t length;
};

struct Parameter {
  Slot slot;
  bool written = false;
};

struct Function {
  std::vector<Type> registers;
  std::vector<Array> arrays;
  std::vector<Parameter> parameters;
  Slot result;
  Block body;

  // The count of numbers in the first parameter.
  uint32_t input_count() const {
    const Slot& input = parameters[0].slot;
    return input.is_array ? arrays[size_t(input.array)].length : uint32_t(input.numbers.size());
  }
};

struct Constant {
  Type type;
  uint32_t bits;  // those of a float32 or a whole number; for a truth 0 or 1
  auto operator<=>(const Constant&) const = default;
};
struct Table {
  Type type;
  std::vector<uint32_t> bits;
  bool operator==(const Table&) const = default;
};

struct Program {
  std::vector<Function> functions;  // a function calls only those before it
  std::vector<Constant> constants;
  std::map<Constant, uint32_t> constant_numbers;
  std::vector<Table> tables;
  uint32_t value = 0;             // index of the function that the text must define
  std::vector<uint32_t> other{};  // index of the optional second function, if the text defines it
  bool counts_iterations = false;
};

}  // namespace eyeray::engine::formula::ir
