// Lowers SPIR-V to a program. Private to this layer.
#pragma once

#include <map>
#include <set>
#include <string>
#include <unordered_map>

#include "host/emulator/program.hpp"
#include "host/emulator/types.hpp"

namespace eyeray::engine::emulator {

// Error (bad_input) for a kernel that needs more of something than the emulator has.
void check_limit(uint64_t count, uint64_t most, const char* of);

// Instructions of NonSemantic.Shader.DebugInfo.100.
constexpr uint32_t debug_source = 35, debug_line = 103, debug_no_line = 104;

class Lowering {
 public:
  explicit Lowering(std::span<const uint32_t> spirv) : module_(spirv::read(spirv)) {}
  Program run();

 private:
  // A value, a pointer or an image.
  struct Value {
    uint32_t type = 0;
    Source source{};          // a pointer's offset
    uint32_t root = no_root;  // the root of a pointer or image
    Placement placement{};    // the placement of a pointer's target
  };

  void declare(const spirv::Instruction& instruction);
  void decorate(const spirv::Instruction& instruction);
  void add_constant(const spirv::Instruction& instruction);
  void add_number(const spirv::Instruction& instruction, Value& made);
  void add_global(const spirv::Instruction& instruction);
  void read_group_size();

  void allot(const spirv::Function& function);
  Space space_of(const Type& type) const;
  void add_uses();
  Function lower_function(const spirv::Function& function);
  void lower_instruction(Function& function, Block& block, const spirv::Instruction& instruction);
  void end_block(const spirv::Function& function, const std::map<uint32_t, uint32_t>& index_of, Block& block,
                 const spirv::Block& from);
  void lower_variable(Function& function, Block& block, const spirv::Instruction& instruction);
  void lower_chain(Block& block, const spirv::Instruction& instruction);
  void lower_composite(Block& block, const spirv::Instruction& instruction);
  bool lower_memory(Block& block, const spirv::Instruction& instruction);
  bool lower_atomic(Block& block, const spirv::Instruction& instruction);
  bool lower_image(Block& block, const spirv::Instruction& instruction);
  void lower_call(Block& block, const spirv::Instruction& instruction);
  void lower_split(Block& block, const spirv::Instruction& instruction);
  void lower_arithmetic(Block& block, const spirv::Instruction& instruction);
  Execute execute_of(const spirv::Instruction& instruction) const;  // null if the emulator has none

  Operation operation(
      const spirv::Instruction& instruction) const;  // with result and location, without operands
  Location location(const spirv::Instruction& instruction) const;
  [[noreturn]] void refuse(const spirv::Instruction& instruction) const;

  const Value& value(uint32_t id) const;
  const Type& type_of(uint32_t id) const { return types_.at(value(id).type); }
  Source source(uint32_t id) const { return value(id).source; }
  Source part(const Source& source, uint32_t first, uint32_t words) const;
  // Words before the part that these literal indices name, and the part's type.
  std::pair<uint32_t, uint32_t> find_part(uint32_t type, std::span<const uint32_t> indices) const;
  Source constant(std::span<const uint32_t> words);
  Source pointer_to(uint32_t offset);  // a constant pointer
  uint32_t registers(uint64_t words);
  // Takes the pointer's root, offset and layout, and notes the use of a buffer.
  void access(Operation& operation, uint32_t pointer, bool writes);

  spirv::Module module_;
  Types types_;
  Program program_;
  std::unordered_map<uint32_t, Value> values_;
  std::map<uint32_t, uint64_t> whole_constants_;                  // by id
  std::map<uint32_t, std::map<uint32_t, uint32_t>> decorations_;  // by id and decoration
  std::map<uint32_t, std::string> names_;                         // by id
  std::map<uint32_t, uint32_t> files_;           // index by the id of the string or of the DebugSource
  std::map<uint32_t, uint32_t> function_index_;  // by id
  std::map<uint32_t, std::vector<uint32_t>> parameter_roots_;  // by the function's id
  std::map<uint32_t, Use> uses_;                               // by root
  std::set<std::pair<uint32_t, uint32_t>> arguments_;          // roots of parameters and of their arguments
  uint64_t cells_ = 0;                                         // the cells of all operations
  uint32_t glsl_ = 0, debug_ = 0;              // ids of GLSL.std.450 and of NonSemantic.Shader.DebugInfo.100
  uint32_t entry_ = 0;                         // id
  uint32_t file_ = 0, line_ = 0, column_ = 0;  // the line of the next instructions
};

}  // namespace eyeray::engine::emulator
