// Runs a function on terms instead of numbers. It follows all iterations of a loop, and both sides of an `if`
// whose condition is not a constant. Where paths join again, the condition selects the value of each
// variable. Private to this layer.
#pragma once

#include <map>

#include "host/formula/arithmetic.hpp"
#include "host/formula/module.hpp"

namespace eyeray::engine::formula {

class Execution {
 public:
  Execution(const Module& module, Expression& expression);

  // The result of the function of this name at the point whose coordinates are the inputs 0, 1, 2. Throws
  // InputError, with the line, for code that cannot be followed.
  Term run(std::string_view function);

 private:
  struct Pointer {
    uint32_t variable = 0;  // key in the Memory
    uint32_t offset = 0;
  };
  using Memory = std::map<uint32_t, Value>;

  // A way that leads to a block or out of the function: the condition under which it is taken, the memory at
  // its end, and the returned value.
  struct Way {
    uint32_t from;  // the block in which it begins
    Term condition;
    Memory memory;
    Value returned;
  };
  struct Call {
    const Function& function;
    std::map<uint32_t, Value> values{};
    std::map<uint32_t, Pointer> pointers{};
    std::map<uint32_t, std::vector<Way>> ways{};  // ways to blocks not yet run, by the block's label
    std::vector<Way> returns{};
    std::vector<uint32_t> from{};    // blocks in which the ways to the current block begin
    std::vector<Term> conditions{};  // the conditions of these ways, in the same order
    Term condition = no_term;
    uint32_t block = 0;
  };

  Value call(const Function& function, const std::vector<uint32_t>& arguments, const Call& caller);
  void run_blocks(Call& call, size_t first, size_t end);
  void run_loop(Call& call, size_t header);
  void run_block(Call& call, const Block& block);
  void run_instruction(Call& call, const Instruction& instruction);
  bool run_memory(Call& call, const Instruction& instruction);
  bool run_composite(Call& call, const Instruction& instruction);
  bool run_branch(Call& call, const Instruction& instruction);

  // Joins ways into `memory_` and `returned`. Returns the condition under which any of them is taken.
  Term join(const std::vector<Way>& ways, Value& returned);
  Value choose(Term condition, const Value& x, const Value& y);
  void go(Call& call, uint32_t to, Term condition);

  const Value& value(const Call& call, uint32_t id);
  Value constant(uint32_t id) const;
  const Pointer& pointer(const Call& call, uint32_t id) const;
  uint32_t new_variable(const Type& type);
  uint32_t index(const Call& call, uint32_t id, const Instruction& instruction);
  [[noreturn]] void refuse(const Instruction& instruction, const std::string& what) const;

  const Module& module_;
  Expression& expression_;
  Memory memory_;
  std::map<uint32_t, Value> constants_;  // used so far, by id
  std::map<uint32_t, Pointer> globals_;
  uint32_t variables_ = 0;
  size_t memory_size_ = 0;  // in numbers
  size_t effort_ = 0;
};

}  // namespace eyeray::engine::formula
