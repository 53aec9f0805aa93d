// The types of a SPIR-V module, and where their numbers lie. Private to this layer.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/emulator/program.hpp"
#include "host/spirv/module.hpp"

namespace eyeray::engine::emulator {

// A struct's member in memory that has a layout.
struct Placement {
  uint32_t offset = 0;  // bytes
  uint32_t matrix_stride = 0;
  bool row_major = false;
};

// A number is a word, or two if it has 64 bits; a bool is a word, too. A value, and a variable without a
// layout, is the words of its parts, one after the other.
struct Type {
  spv::Op op = spv::OpTypeVoid;
  uint32_t words = 0;    // 0 for a pointer, an image, and a type with a run-time array
  uint32_t bits = 32;    // a number's, and those of a vector's or matrix's numbers
  bool real = false;     // whether these are floats
  uint32_t element = 0;  // id; of a vector, matrix, array or pointer; the numbers of an image
  uint32_t count = 0;    // elements; 0: a run-time array
  uint32_t stride = 0;   // bytes between the elements of an array with a layout
  bool is_signed = false;
  spv::StorageClass storage = spv::StorageClassFunction;  // the storage class of a pointer
  std::vector<uint32_t> members{};                        // ids
  std::vector<Placement> placements{};                    // the placements of members with a layout
  std::vector<std::string> names{};                       // the members' names, some may be empty
  bool arrayed = false;                                   // an image's
  spv::Dim dim = spv::DimMax;                             // an image's

  uint32_t number_words() const { return bits == 64 ? 2 : 1; }
  // The bits of a signed whole number, else 0.
  uint32_t signed_bits() const { return is_signed ? bits : 0; }
};

// An image, texel buffer or sampler: a value without words.
bool is_image(const Type& type);

class Types {
 public:
  // Error (bad_input) for types that the emulator does not have. `constant`: the value of a whole-number
  // constant.
  void add(const spirv::Instruction& instruction, const std::map<uint32_t, uint64_t>& constants);
  // Notes an OpMemberName or a decoration, which precede the type.
  void decorate(const spirv::Instruction& instruction);

  const Type& at(uint32_t id) const;
  bool is_type(uint32_t id) const { return types_.contains(id); }

  // The cell of each word of a value in memory with a layout. `placement`: that of the struct's member whose
  // type this is.
  std::vector<Cell> cells(uint32_t type, const Placement& placement = {}) const;
  // Words before a struct's member.
  uint32_t words_before(const Type& type, uint32_t member) const;

 private:
  std::map<uint32_t, Type> types_;
  std::map<uint32_t, uint32_t> strides_;                          // by the array's id
  std::map<uint32_t, std::map<uint32_t, Placement>> placements_;  // by the struct's id and the member
  std::map<uint32_t, std::map<uint32_t, std::string>> names_;     // the members' names, by the struct's id
};

}  // namespace eyeray::engine::emulator
