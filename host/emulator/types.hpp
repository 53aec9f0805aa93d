// The types of a SPIR-V module, and where their numbers lie. Private to this layer.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "host/spirv/module.hpp"

namespace eyeray::engine::emulator {

// A struct's member in memory that has a layout.
struct Placement {
  uint32_t offset = 0;  // bytes
  uint32_t matrix_stride = 0;
  bool row_major = false;
};

// Numbers are words of 32 bits; a bool is one, too. A value, and a variable without a layout, is the words of
// its parts, one after the other.
struct Type {
  spv::Op op = spv::OpTypeVoid;
  uint32_t words = 0;    // 0 for a pointer, an image, and a type with a run-time array
  uint32_t element = 0;  // id; of a vector, matrix, array or pointer
  uint32_t count = 0;    // elements; 0: a run-time array
  uint32_t stride = 0;   // bytes between the elements of an array with a layout
  bool is_signed = false;
  spv::StorageClass storage = spv::StorageClassFunction;  // the storage class of a pointer
  std::vector<uint32_t> members{};                        // ids
  std::vector<Placement> placements{};                    // the placements of members with a layout
};

class Types {
 public:
  // Error (bad_input) for types that the emulator does not have. `constant`: the value of a whole-number
  // constant.
  void add(const spirv::Instruction& instruction, const std::map<uint32_t, uint32_t>& constants);
  // Notes a decoration, which precedes the type.
  void decorate(const spirv::Instruction& instruction);

  const Type& at(uint32_t id) const;
  bool is_type(uint32_t id) const { return types_.contains(id); }

  // The byte of each word of a value in memory with a layout. `placement`: that of the struct's member whose
  // type this is.
  std::vector<uint32_t> bytes(uint32_t type, const Placement& placement = {}) const;
  // Words before a struct's member.
  uint32_t words_before(const Type& type, uint32_t member) const;

 private:
  std::map<uint32_t, Type> types_;
  std::map<uint32_t, uint32_t> strides_;                          // by the array's id
  std::map<uint32_t, std::map<uint32_t, Placement>> placements_;  // by the struct's id and the member
};

}  // namespace eyeray::engine::emulator
