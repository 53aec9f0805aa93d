// Turns a program into the machine's code. The code of a function replaces each call; branches and loops
// become jumps.
#include <algorithm>
#include <atomic>

#include "host/core/error.hpp"
#include "host/formula/machine.hpp"

namespace eyeray::engine::formula {

class Assembler {
 public:
  Assembler(Machine& machine, const ir::Program& program) : machine_(machine), program_(program) {}

  void run(uint32_t number) {
    for (const ir::Constant& constant : program_.constants)
      constants_.push_back(constant.type == ir::Type::real
                               ? add(machine_.reals_, __builtin_bit_cast(float, constant.bits))
                               : add(machine_.wholes_, constant.bits));
    for (const ir::Table& table : program_.tables) {
      const bool real = table.type == ir::Type::real;
      tables_.push_back(uint32_t(real ? machine_.reals_.size() : machine_.wholes_.size()));
      for (const uint32_t bits : table.bits)
        real ? add(machine_.reals_, __builtin_bit_cast(float, bits)) : add(machine_.wholes_, bits);
    }
    real_top_ = uint32_t(machine_.reals_.size());
    whole_top_ = uint32_t(machine_.wholes_.size());

    // Reserves the input's floats, then writes the call.
    machine_.input_ = real_top_;
    machine_.input_count_ = program_.functions[number].input_count();
    Positions input{{}, true, ir::Type::real};
    while (input.at.size() < machine_.input_count_) input.at.push_back(real_top_++);
    Frame frame = enter(program_.functions[number]);
    const Positions results = positions_of(frame, frame.function.result);
    machine_.results_ = results.at;
    machine_.gives_reals_ = results.type == ir::Type::real;
    call(frame, {input});
    emit({.op = Machine::end});
    machine_.real_count_ = std::max(real_most_, real_top_);
    machine_.whole_count_ = std::max(whole_most_, whole_top_);
  }

 private:
  using Code = Machine::Code;

  // The positions of a value's numbers in one of the machine's files.
  struct Positions {
    std::vector<uint32_t> at;
    bool in_a_row = false;
    ir::Type type = ir::Type::real;
  };
  // One call of a function, with the positions of the function's registers and arrays.
  struct Frame {
    const ir::Function& function;
    std::vector<uint32_t> registers{};
    std::vector<uint32_t> arrays{};
    std::vector<size_t> returns{};  // jumps to the function's end
  };
  struct LoopJumps {
    std::vector<size_t> leaves, nexts;
  };

  template <typename T>
  static uint32_t add(std::vector<T>& file, T value) {
    file.push_back(value);
    return uint32_t(file.size() - 1);
  }

  Frame enter(const ir::Function& function) {
    Frame frame{.function = function};
    const auto take = [&](ir::Type type, uint32_t count) {
      uint32_t& top = type == ir::Type::real ? real_top_ : whole_top_;
      return std::exchange(top, top + count);
    };
    for (const ir::Type type : function.registers) frame.registers.push_back(take(type, 1));
    for (const ir::Array& array : function.arrays) frame.arrays.push_back(take(array.type, array.length));
    real_most_ = std::max(real_most_, real_top_);
    whole_most_ = std::max(whole_most_, whole_top_);
    return frame;
  }

  // Writes the function's code for a call with `arguments`. A parameter shares the position of its argument
  // if nothing can observe the difference. Else the argument is copied, and copied back if it is written to.
  void call(Frame& frame, const std::vector<Positions>& arguments) {
    std::vector<std::pair<Positions, Positions>> back;  // (to, from), copied after the call
    for (size_t i = 0; i < arguments.size(); ++i) {
      const ir::Parameter& parameter = frame.function.parameters[i];
      const bool is_shared = parameter.written && std::ranges::any_of(arguments, [&](const Positions& other) {
                               return &other != &arguments[i] && overlap(other, arguments[i]);
                             });
      const bool fits = !parameter.slot.is_array || arguments[i].in_a_row;
      const bool is_constant =
          parameter.written && !arguments[i].at.empty() && arguments[i].at[0] < input_end(arguments[i].type);
      if (!is_shared && fits && !is_constant) {
        if (parameter.slot.is_array) frame.arrays[size_t(parameter.slot.array)] = arguments[i].at[0];
        for (size_t k = 0; k < parameter.slot.numbers.size(); ++k)
          frame.registers[size_t(parameter.slot.numbers[k])] = arguments[i].at[k];
        continue;
      }
      const Positions own = positions_of(frame, parameter.slot);
      move(own, arguments[i]);
      if (parameter.written) back.push_back({arguments[i], own});
    }
    write(frame, frame.function.body);
    // A return at the very end needs no jump, since the next code follows.
    if (!frame.returns.empty() && frame.returns.back() + 1 == machine_.code_.size()) {
      machine_.code_.pop_back();
      frame.returns.pop_back();
    }
    for (const size_t at : frame.returns) land(at);
    for (const auto& [to, from] : back) move(to, from);
  }

  // Positions below this one hold constants or, in the file of floats, the input.
  uint32_t input_end(ir::Type type) const {
    return type == ir::Type::real ? machine_.input_ + machine_.input_count_
                                  : uint32_t(machine_.wholes_.size());
  }
  static bool overlap(const Positions& a, const Positions& b) {
    const bool same_file = (a.type == ir::Type::real) == (b.type == ir::Type::real);
    return same_file && std::ranges::any_of(a.at, [&](uint32_t position) {
             return std::ranges::find(b.at, position) != b.at.end();
           });
  }
  void move(const Positions& to, const Positions& from) {
    for (size_t i = 0; i < to.at.size(); ++i)
      emit({.op = to.type == ir::Type::real ? uint16_t(Machine::move_real) : uint16_t(ir::Op::move),
            .to = to.at[i],
            .from = {from.at[i]}});
  }

  ir::Type type_of(const Frame& frame, ir::Operand operand) const {
    return operand < 0 ? program_.constants[size_t(~operand)].type
                       : frame.function.registers[size_t(operand)];
  }
  uint32_t position_of(const Frame& frame, ir::Operand operand) const {
    return operand < 0 ? constants_[size_t(~operand)] : frame.registers[size_t(operand)];
  }
  ir::Array array(const Frame& frame, ir::ArrayId id) const {
    if (id >= 0) return frame.function.arrays[size_t(id)];
    const ir::Table& table = program_.tables[size_t(~id)];
    return {table.type, uint32_t(table.bits.size())};
  }
  uint32_t first(const Frame& frame, ir::ArrayId id) const {
    return id < 0 ? tables_[size_t(~id)] : frame.arrays[size_t(id)];
  }
  Positions positions_of(const Frame& frame, const ir::Slot& slot) const {
    Positions result;
    if (slot.is_array) {
      const auto [type, length] = array(frame, slot.array);
      for (uint32_t i = 0; i < length; ++i) result.at.push_back(first(frame, slot.array) + i);
      result.in_a_row = true;
      result.type = type;
    } else {
      for (const ir::Operand number : slot.numbers) result.at.push_back(position_of(frame, number));
      if (!slot.numbers.empty()) result.type = type_of(frame, slot.numbers[0]);
    }
    return result;
  }

  size_t emit(const Code& code) {
    machine_.code_.push_back(code);
    return machine_.code_.size() - 1;
  }
  // Makes the jump at `at` lead to the next code.
  void land(size_t at) { machine_.code_[at].to = uint32_t(machine_.code_.size()); }

  void write(Frame& frame, const ir::Block& block) {
    for (const ir::Statement& statement : block)
      std::visit([&](const auto& what) { write(frame, what); }, statement.what);
  }

  void write(Frame& frame, const ir::Instruction& instruction) {
    using ir::Op;
    Code code{.op = uint16_t(instruction.op)};
    const auto from = [&](size_t i) { return position_of(frame, instruction.from[i]); };
    const auto real = [&](Machine::Control control) { code.op = control; };
    switch (instruction.op) {
      case Op::load:
      case Op::store:
      case Op::clear:
      case Op::copy: {
        const auto [type, length] = array(frame, instruction.array);
        code.array = first(frame, instruction.array);
        code.length = length;
        if (instruction.op == Op::load) code.to = position_of(frame, instruction.to);
        if (instruction.op == Op::load || instruction.op == Op::store) code.from[0] = from(0);
        if (instruction.op == Op::store) code.from[1] = from(1);
        if (instruction.op == Op::copy) code.from[0] = first(frame, instruction.other);
        if (type == ir::Type::real)
          real(instruction.op == Op::load    ? Machine::load_real
               : instruction.op == Op::store ? Machine::store_real
               : instruction.op == Op::clear ? Machine::clear_real
                                             : Machine::copy_real);
        break;
      }
      case Op::clamp_index:
        // The length is a constant, and bounds the indices.
        code.length = program_.constants[size_t(~instruction.from[1])].bits;
        [[fallthrough]];
      default:
        code.to = position_of(frame, instruction.to);
        for (size_t i = 0; i < 3; ++i) code.from[i] = from(i);
        if (type_of(frame, instruction.to) == ir::Type::real && instruction.op == Op::move)
          real(Machine::move_real);
        if (type_of(frame, instruction.to) == ir::Type::real && instruction.op == Op::select)
          real(Machine::select_real);
    }
    emit(code);
  }

  void write(Frame& frame, const ir::Call& call) {
    const auto [reals, wholes] = std::pair(real_top_, whole_top_);
    std::vector<Positions> arguments;
    for (const ir::Slot& slot : call.arguments) arguments.push_back(positions_of(frame, slot));
    Frame inner = enter(program_.functions[call.function]);
    // The function writes its result straight to the position in the caller, which nothing else uses.
    const ir::Slot& result = inner.function.result;
    if (result.is_array) inner.arrays[size_t(result.array)] = first(frame, call.result.array);
    for (size_t i = 0; i < result.numbers.size(); ++i)
      inner.registers[size_t(result.numbers[i])] = position_of(frame, call.result.numbers[i]);
    this->call(inner, arguments);
    real_top_ = reals;
    whole_top_ = wholes;
  }

  void write(Frame& frame, const ir::Branch& branch) {
    const uint32_t condition = position_of(frame, branch.condition);
    if (branch.yes.empty()) {
      const size_t over = emit({.op = Machine::jump_if, .from = {condition}});
      write(frame, branch.no);
      land(over);
      return;
    }
    const size_t otherwise = emit({.op = Machine::jump_unless, .from = {condition}});
    write(frame, branch.yes);
    if (branch.no.empty()) {
      land(otherwise);
      return;
    }
    const size_t over = emit({.op = Machine::jump});
    land(otherwise);
    write(frame, branch.no);
    land(over);
  }

  void write(Frame& frame, const ir::Loop& loop) {
    loops_.push_back({});
    const auto start = uint32_t(machine_.code_.size());
    if (loop.iterations == 0) emit({.op = Machine::iterate, .length = loop.weight});
    write(frame, loop.body);
    for (const size_t at : loops_.back().nexts) land(at);
    write(frame, loop.next);
    emit({.op = Machine::jump, .to = start});
    for (const size_t at : loops_.back().leaves) land(at);
    loops_.pop_back();
  }

  void write(Frame& frame, const ir::Jump& jump) {
    const size_t at = emit({.op = Machine::jump});
    if (jump == ir::Jump::give_back)
      frame.returns.push_back(at);
    else
      (jump == ir::Jump::leave ? loops_.back().leaves : loops_.back().nexts).push_back(at);
  }

  Machine& machine_;
  const ir::Program& program_;
  std::vector<uint32_t> constants_, tables_;  // positions in the files
  uint32_t real_top_ = 0, whole_top_ = 0;     // the first free position in each file
  uint32_t real_most_ = 0, whole_most_ = 0;
  std::vector<LoopJumps> loops_;
};

Machine::Machine(const ir::Program& program, uint32_t function) {
  static std::atomic<uint64_t> machines = 0;
  id_ = ++machines;
  Assembler(*this, program).run(function);
}

}  // namespace eyeray::engine::formula
