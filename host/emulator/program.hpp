// A compute kernel as operations on words, lowered from its SPIR-V. Private to this layer.
//
// Each value has a register of words. Each variable of a single invocation has one, too. All invocations of a
// work group execute an operation together, as far as they have come to its block.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <spirv/unified1/spirv.hpp>

#include "host/emulator/location.hpp"

namespace eyeray::engine::emulator {

class Types;

// Words of an operand: of a register, or of the constants.
struct Source {
  uint32_t at = 0;
  uint32_t words = 0;
  bool constant = false;
};

enum class Space : uint8_t {
  own,     // registers
  shared,  // memory of the work group
  buffer,  // storage and uniform buffers
  image,   // images and texel buffers
  pushed,  // push constants
};

// A pointer has three words: the offset from the start of its root, in words for `own` and `shared`, else in
// bytes. If an index on the way was out of bounds, the offset is `nowhere`, followed by that index and the
// number of elements that it had to choose from.
constexpr uint32_t pointer_words = 3;
constexpr uint32_t nowhere = UINT32_MAX;

// The variable that a pointer points into.
struct Root {
  Space space = Space::own;
  uint32_t at =
      0;  // first register or shared word; of a buffer its binding; of a parameter no_root, until its call
  uint32_t size = 0;       // words, of variables
  std::string name{};      // for findings
  uint32_t type = 0;       // id, of the variable
  bool anonymous = false;  // a block without a name of its own: its members are named alone
};

// A word of a value in memory that has a layout.
struct Cell {
  uint32_t byte = 0;
  uint32_t size = 4;       // bytes: 1, 2 or 4
  uint32_t real_bits = 0;  // the bits of the float that this word is, or is the high word of; else 0
};

// An index of an access chain.
struct Step {
  Source index;
  uint32_t signed_bits = 0;
  uint32_t stride = 0;
  uint32_t count = 0;   // elements; 0 for a run-time array, which ends with its buffer
  uint32_t before = 0;  // the run-time array's start in the buffer, if no other index is in front of it
};

class Group;
struct Operation;
// Executes an operation for the active invocations of a work group.
using Execute = void (*)(Group&, const Operation&);

struct Operation {
  Execute execute = nullptr;
  uint32_t to = 0;     // the result's register
  uint32_t words = 0;  // size of the result
  uint32_t type = 0;   // id: of the result, or of the value in memory
  std::vector<Source> from{};
  std::vector<uint32_t> literals{};  // the instruction's operands that are no ids
  uint32_t root = 0;                 // the pointer that is read, written or made
  std::vector<Cell> cells{};         // those of a buffer's value, word by word
  std::vector<Step> steps{};         // the steps of an access chain
  Location location{};
};

struct Move {
  uint32_t to = 0;
  Source from;
};

// A way to another block, with the values that the block's phis get.
struct Way {
  uint32_t block = 0;  // index
  std::vector<Move> moves{};
};

struct Block {
  std::vector<Operation> operations{};
  spv::Op end = spv::OpReturn;
  Source condition{};             // the condition of a branch, or the returned value
  uint32_t type = 0;              // its id
  std::vector<uint32_t> cases{};  // the values of a switch for its ways after the first, the default
  uint64_t effort = 0;            // words that its operations write or move, of an invocation
  std::vector<Way> ways{};
  Location location{};
};

// Blocks are in an order in which every construct comes before its merge block, and a loop's continue block
// after its body. So invocations that wait at the block of the greatest index reconverge there.
struct Function {
  std::vector<Block> blocks{};
  std::vector<uint32_t> parameters{};  // registers
  std::vector<uint32_t> roots{};       // the root that a call sets for each parameter, or none
  std::vector<std::pair<uint32_t, uint32_t>> variables{};  // registers and words, without values at the start
  uint32_t result = 0;                                     // register of the returned value
};

constexpr uint32_t no_root = UINT32_MAX;

struct BuiltIn {
  spv::BuiltIn kind = spv::BuiltInMax;
  uint32_t at = 0;  // register
};

// A kernel's use of a buffer or an image.
struct Use {
  bool writes = false;
  uint32_t unit = 4;  // bytes of the smallest access to a buffer
};

struct Program {
  std::array<uint32_t, 3> group{1, 1, 1};  // invocations of a work group, along each axis
  uint32_t registers = 0;                  // words
  uint32_t shared = 0;                     // words
  std::vector<uint32_t> constants{};
  std::vector<Root> roots{};
  std::map<uint32_t, Use> uses{};  // by binding
  std::vector<BuiltIn> built_ins{};
  std::vector<std::pair<uint32_t, uint32_t>> privates{};  // registers and words of private variables
  std::vector<Operation> prelude{};                       // the initial values of global variables
  std::vector<Function> functions{};
  std::vector<std::string> files{};
  std::shared_ptr<const Types> types{};
  uint32_t entry = 0;  // index

  uint32_t invocations() const { return group[0] * group[1] * group[2]; }
};

// Error (bad_input), with the instruction, for SPIR-V that the emulator does not have.
Program lower(std::span<const uint32_t> spirv);

}  // namespace eyeray::engine::emulator
