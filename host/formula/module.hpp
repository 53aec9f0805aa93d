// A SPIR-V module as glslang writes it, split into types, constants and functions. Private to this layer.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <spirv/unified1/spirv.hpp>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine::formula {

// A type as a flat list of numbers: a vector, matrix, array or struct is the numbers of its members, one
// after the other.
struct Type {
  spv::Op op = spv::OpTypeVoid;
  uint32_t size = 0;              // count of numbers; 0 for a pointer
  std::vector<uint32_t> members;  // ids of the members' types; for a pointer its target's
  bool is_signed = false;

  uint32_t member_offset(const std::map<uint32_t, Type>& types, uint32_t index) const;
};

struct Instruction {
  spv::Op op;
  uint32_t type = 0, result = 0;  // ids; 0 if the instruction has none
  std::vector<uint32_t> words{};  // the words after type and result
  SourcePosition where;
};

struct Block {
  uint32_t label = 0;
  uint32_t merge = 0;  // for a loop's header its merge block, else 0
  uint32_t next = 0;   // for a loop's header its continue target, else 0
  uint32_t join = 0;   // for a selection's header the block where its ways join again, else 0
  std::vector<Instruction> instructions{};
};

struct Function {
  uint32_t id = 0;
  std::vector<uint32_t> parameters;
  std::vector<Block> blocks;
  std::map<uint32_t, size_t> block_of;  // a block's index, by its label
};

struct Module {
  std::map<uint32_t, Type> types;
  std::vector<Instruction> constants;  // and global variables, in order
  std::vector<Function> functions;     // in the order of the module

  // Throws Error for words that are no SPIR-V, InputError for types or variables that are too large.
  explicit Module(std::span<const uint32_t> spirv);

  const Function& function(uint32_t id) const;
  // The function of this name, mangled as glslang does, "f(vf3;"; null if there is none.
  const Function* named(std::string_view name) const;

  const Type& type(uint32_t id) const { return types.at(id); }
  // The type of the value or variable that `id` names.
  const Type& type_of(uint32_t id) const { return types.at(value_types_.at(id)); }
  // The value of `id`, if that is a constant whole number.
  std::optional<uint32_t> constant(uint32_t id) const;
  bool is_constant(uint32_t id) const { return constant_bits_.contains(id); }
  // The bits of a constant's numbers, flat.
  const std::vector<uint32_t>& constant_bits(uint32_t id) const { return constant_bits_.at(id); }
  bool is_zero(uint32_t id) const;  // true for a constant whose bits are all 0
  // Makes the value `id` a constant with these bits.
  void define_constant(uint32_t id, std::vector<uint32_t> bits) { constant_bits_[id] = std::move(bits); }
  // Adds a constant 0 of this type. Returns its id.
  uint32_t new_zero(uint32_t type);
  // The local and global variables of which every read gives the same constant, with that constant's id.
  // fold() finds them.
  std::map<uint32_t, uint32_t> held;

 private:
  void read_type(spv::Op op, std::span<const uint32_t> words);
  void count_variable(const Instruction& variable);
  void read_constant(const Instruction& instruction);
  std::map<uint32_t, uint32_t> value_types_;
  std::map<uint32_t, std::vector<uint32_t>> constant_bits_;
  std::map<uint32_t, std::string> names_;
  uint64_t variable_numbers_ = 0;
  uint32_t new_ids_ = 0x80000000;  // the next new id; glslang's are below
};

}  // namespace eyeray::engine::formula
