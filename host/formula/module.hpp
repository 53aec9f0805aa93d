// A SPIR-V module as glslang writes it, in pieces. Private to this layer.
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

// Numbers lie flat: a vector, matrix, array or struct is the numbers of its members, one after the other.
struct Type {
  spv::Op op = spv::OpTypeVoid;
  uint32_t size = 0;              // numbers; of a pointer 0
  std::vector<uint32_t> members;  // types; of a pointer its target's
  bool is_signed = false;

  uint32_t member_offset(const std::map<uint32_t, Type>& types, uint32_t index) const;
};

struct Instruction {
  spv::Op op;
  uint32_t type = 0, result = 0;  // 0 where there are none
  std::vector<uint32_t> words{};  // the words after them
  SourcePosition where;
};

struct Block {
  uint32_t label = 0;
  uint32_t merge = 0;  // of a loop's header, else 0
  uint32_t next = 0;   // of a loop's header: its continue target
  uint32_t join = 0;   // where a selection's ways join again, else 0
  std::vector<Instruction> instructions{};
};

struct Function {
  uint32_t id = 0;
  std::vector<uint32_t> parameters;
  std::vector<Block> blocks;
  std::map<uint32_t, size_t> block_of;  // by label
};

struct Module {
  std::map<uint32_t, Type> types;
  std::vector<Instruction> constants;  // and variables outside functions, in order
  std::vector<Function> functions;     // in the order in which they stand

  // Error for words that are no SPIR-V; InputError for types and variables that are too large to be held.
  explicit Module(std::span<const uint32_t> spirv);

  const Function& function(uint32_t id) const;
  // The one of this name, mangled as glslang does, "f(vf3;"; null where there is none.
  const Function* named(std::string_view name) const;

  const Type& type(uint32_t id) const { return types.at(id); }
  // The type of the value or variable that `id` names.
  const Type& type_of(uint32_t id) const { return types.at(value_types_.at(id)); }
  // A whole number that `id` names as a constant.
  std::optional<uint32_t> constant(uint32_t id) const;
  bool is_constant(uint32_t id) const { return constant_bits_.contains(id); }
  // The bits of a constant's numbers, flat.
  const std::vector<uint32_t>& constant_bits(uint32_t id) const { return constant_bits_.at(id); }
  bool is_zero(uint32_t id) const;  // a constant, of zero bits
  // Makes a constant of the value `id`, or of a new one of this type.
  void define_constant(uint32_t id, std::vector<uint32_t> bits) { constant_bits_[id] = std::move(bits); }
  uint32_t new_zero(uint32_t type);
  // The variables, in and outside of functions, that are only ever seen as one constant: fold() finds them.
  std::map<uint32_t, uint32_t> held;

 private:
  void read_type(spv::Op op, std::span<const uint32_t> words);
  void count_variable(const Instruction& variable);
  void read_constant(const Instruction& instruction);
  std::map<uint32_t, uint32_t> value_types_;
  std::map<uint32_t, std::vector<uint32_t>> constant_bits_;
  std::map<uint32_t, std::string> names_;
  uint64_t variable_numbers_ = 0;
  uint32_t new_ids_ = 0x80000000;  // glslang's are below
};

}  // namespace eyeray::engine::formula
