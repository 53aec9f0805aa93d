// A formula as a program over single numbers: as its SPIR-V states it, with nothing undefined left. Every
// executor runs this, in its own arithmetic: the interpreter in float32 and float64, kernels as GLSL. Private
// to this layer.
//
// Whole numbers wrap around, shifts take the last five bits of their distance, x / 0 = x % 0 = 0, indices are
// clamped into their arrays, conversions of a value that no whole number holds give the least int or 0u. A
// variable that is read before it is written is 0.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <variant>
#include <vector>

namespace eyeray::engine::formula::ir {

// A float; the 32 bits of an int or uint; a bool.
enum class Type : uint8_t { real, whole, truth };

enum class Op : uint8_t {
  move,  // of any type
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
  clamp_index,  // the second whole number, a signed one, into [0, third)
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
  select,  // by a truth, of any type
  // Memory: array[from 0], array[from 0] = from 1; all of an array: to 0, or those of another one.
  load,
  store,
  clear,
  copy,
};

// A register of the function, or ~index of one of the program's constants.
using Operand = int32_t;
// An array of the function's, or ~index of one of the program's tables.
using ArrayId = int32_t;

struct Instruction {
  Op op;
  Operand to = 0;
  std::array<Operand, 3> from{};
  ArrayId array = 0, other = 0;
};

// The position of a value: its numbers, by columns for a matrix; or an array.
struct Place {
  std::vector<Operand> numbers{};
  bool is_array = false;
  ArrayId array = 0;
};

struct Statement;
using Block = std::vector<Statement>;

// Arguments are copied in, and those that the function writes to copied back, like the result.
struct Call {
  uint32_t function;
  std::vector<Place> arguments;
  Place result;
};
struct Branch {
  Operand condition;
  Block yes, no;
};
// Repeats until it is left. `next` follows each iteration.
struct Loop {
  Block body, next;
  uint32_t iterations = 0;  // most iterations, if that is known and needs no counting; else 0
  uint32_t weight = 0;      // weight of an iteration, if iterations are counted
};
enum class Jump : uint8_t { leave, next, give_back };  // of the innermost loop; of the function

struct Statement {
  std::variant<Instruction, Call, Branch, Loop, Jump> what;
};

struct Array {
  Type type;
  uint32_t length;
};

struct Parameter {
  Place place;
  bool written = false;
};

struct Function {
  std::vector<Type> registers;
  std::vector<Array> arrays;
  std::vector<Parameter> parameters;
  Place result;
  Block body;

  // The numbers that the first parameter has.
  uint32_t input_count() const {
    const Place& input = parameters[0].place;
    return input.is_array ? arrays[size_t(input.array)].length : uint32_t(input.numbers.size());
  }
};

struct Constant {
  Type type;
  uint32_t bits;  // of a float32, of a whole number, 0 or 1
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
  uint32_t value = 0;             // the function that the text must define
  std::vector<uint32_t> other{};  // the function that it may have beside, if there is one
  bool counts_iterations = false;
};

}  // namespace eyeray::engine::formula::ir
