// Lowers SPIR-V to the program of ir.hpp. Private to this layer.
#pragma once

#include <map>
#include <set>
#include <string_view>

#include "host/formula/ir.hpp"
#include "host/formula/module.hpp"

namespace eyeray::engine::formula {

// The program of the module's functions `value` and `other`, with the functions that they call. Both names
// are as in Module::named; the module may lack `other`. Throws InputError, with the line, for code that
// formulas cannot have.
ir::Program lower(const Module& module, std::string_view value, std::string_view other);

// The program of one function without input, which computes the result of `instruction` on constants.
ir::Program lower(const Module& module, const Instruction& instruction);

// Lowers one function.
class FunctionLowering {
 public:
  // `numbers`: the index in `program` of each function lowered so far, by its id.
  FunctionLowering(const Module& module, ir::Program& program, const std::map<uint32_t, uint32_t>& numbers,
                   const Function& function);
  ir::Function run();
  ir::Function run(const Instruction& instruction);

 private:
  // The position of a variable or of a part of it. The part begins at number `offset` of the variable or, if
  // its index is not a constant, at the number that the operand `address` holds.
  struct Pointer {
    uint32_t variable = 0;
    ir::Slot slot;
    const Type* type = nullptr;
    uint32_t offset = 0;
    bool is_dynamic = false;
    ir::Operand address = 0;
  };
  struct LoopLabels {
    uint32_t header, merge, next;
    bool in_next = false;
  };
  // The number of a value's uses, and the position of the last use in the value's own block. The position is
  // past the block's end if another block uses the value.
  struct Uses {
    size_t count = 0;
    size_t last = 0;
  };
  // The accesses to a variable, by the indices of blocks, and of instructions in a block.
  struct Accesses {
    std::set<size_t> blocks{};
    std::map<size_t, std::set<size_t>> writes{};  // instructions, by block
    size_t first_block = 0;
    bool first_is_store = false;
    bool is_indexed = false;  // by an index that is not a constant
    size_t stores = 0;        // writes of the whole variable
    size_t part_writes = 0;   // other writes
  };

  void look_ahead();
  void count_uses(size_t block);
  void note_accesses();

  // Lowers the blocks in order, from `label` to the one before `stop`.
  void lower_from(uint32_t label, uint32_t stop, ir::Block& out);
  void lower_instructions(const Block& block, ir::Block& out);
  bool lower_branch(const Block& block, uint32_t& label, ir::Block& out);
  bool jump(uint32_t label, ir::Block& out) const;
  void give_back(const Instruction& terminator, ir::Block& out);

  void lower_instruction(const Instruction& instruction, ir::Block& out);
  bool lower_memory(const Instruction& instruction, ir::Block& out);
  bool lower_composite(const Instruction& instruction, ir::Block& out);
  bool lower_arithmetic(const Instruction& instruction, ir::Block& out);
  bool lower_function(const Instruction& instruction, ir::Block& out);
  void lower_constant_variable(const Instruction& variable, ir::Block& out);
  void lower_call(const Instruction& instruction, ir::Block& out);
  Pointer index(const Instruction& instruction, ir::Block& out);
  void load(const Instruction& instruction, ir::Block& out);
  void store(const Instruction& instruction, ir::Block& out);

  // Appends one instruction to `out`. Returns the new register that holds its result.
  ir::Operand apply(ir::Block& out, ir::Op op, ir::Operand x, ir::Operand y = 0, ir::Operand z = 0);
  void each(ir::Block& out, const Instruction& instruction, ir::Op op, const std::vector<ir::Slot>& from);
  ir::Operand sum_of_products(ir::Block& out, const ir::Slot& a, const ir::Slot& b);
  void assign(const std::vector<ir::Operand>& to, std::vector<ir::Operand> from, ir::Block& out);
  bool retarget(const std::vector<ir::Operand>& to, const std::vector<ir::Operand>& from,
                ir::Block& out) const;
  void copy(const ir::Slot& to, const ir::Slot& from, ir::Block& out);

  ir::Operand new_register(ir::Type type);
  ir::Operand constant(ir::Type type, uint32_t bits);
  ir::Operand real(float value);
  ir::Operand whole(uint32_t value) { return constant(ir::Type::whole, value); }
  ir::Slot new_slot(const Type& type, bool as_array);
  ir::Slot constant_slot(uint32_t id);
  const ir::Slot& value(uint32_t id);
  const Pointer& pointer(uint32_t id) const;
  ir::Type scalar(const Type& type) const;
  ir::Type type_of(ir::Operand operand) const;
  [[noreturn]] void refuse(const Instruction& instruction, const std::string& what) const;

  const Module& module_;
  ir::Program& program_;
  const std::map<uint32_t, uint32_t>& numbers_;
  const Function& function_;
  ir::Function out_;
  std::map<uint32_t, ir::Slot> values_;
  std::map<uint32_t, Pointer> pointers_;
  std::map<uint32_t, Accesses> accesses_;
  std::map<uint32_t, size_t> defined_in_;  // the block that defines a value, by the value's id
  std::map<uint32_t, Uses> uses_;
  std::map<uint32_t, std::vector<std::pair<uint32_t, uint32_t>>> phis_;  // (result, value), by the block left
  std::vector<LoopLabels> loops_;
  std::set<uint32_t> computed_;  // values of which each number is the result of its own instruction
  size_t block_ = 0, at_ = 0;    // the indices of the block and instruction that are lowered now
};

}  // namespace eyeray::engine::formula
