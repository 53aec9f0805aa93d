// Records the lines and values of one invocation. Private to this layer.
#pragma once

#include "host/emulator/program.hpp"
#include "host/emulator/trace.hpp"

namespace eyeray::engine::emulator {

class Group;

class Tracer {
 public:
  Tracer(const Program& program, Trace& trace);
  const std::array<uint32_t, 3>& invocation() const { return trace_.invocation; }

  // Called in the order of execution, with the invocation's number in its work group.
  void enter(const Block& block);
  void before(Group& group, const Operation& operation, uint32_t lane);  // before an access to memory
  void after(Group& group, const Operation& operation, uint32_t lane);
  void result(Group& group, const Operation& operation, uint32_t lane);  // after any other operation
  void end(Group& group, const Block& block, uint32_t lane);
  void finish();  // at the end of the invocation

 private:
  void go_to(const Location& location);
  void add(TracedValue value);
  void add_write(Group& group, const Operation& operation, uint32_t lane, const std::string& name);
  std::string text_in_registers(Group& group, const Source& source, uint32_t type, uint32_t lane) const;

  const Program& program_;
  Trace& trace_;
  bool has_lines_ = false;
  TracedLine line_{};                                // the present one
  bool in_line_ = false;                             // whether there is one
  bool matches_ = false;                             // whether it accesses the followed name
  const Block* block_ = nullptr;                     // the present one
  const Block* line_block_ = nullptr;                // the one in which the line began
  std::optional<std::array<uint32_t, 3>> writer_{};  // who wrote the memory that the next access reads
};

// True for an operation that reads or writes a variable, a buffer or shared memory.
bool is_access(const Operation& operation);

}  // namespace eyeray::engine::emulator
