#include "host/formula/limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace eyeray::engine::formula {

namespace {

constexpr double most_instructions = 1 << 14;
constexpr double most_branches = 256;
constexpr double most_memory = 1 << 13;
constexpr double most_work = 1 << 18;
// A loop needs no counting if its number of iterations is known and their work together is at most this.
constexpr double most_uncounted_work = 1 << 16;
// The weight of an iteration is 1 plus the number of its instructions divided by this.
constexpr double work_of_an_iteration = 256;

class Measure {
 public:
  explicit Measure(ir::Program& program) : program_(program) {}

  std::vector<Size> run() {
    for (ir::Function& function : program_.functions) {
      function_ = &function;
      Size size = of(function.body);
      for (const ir::Array& array : function.arrays) size.memory += array.length;
      size.memory += most_called_;
      most_called_ = 0;
      sizes_.push_back(size);
    }
    return std::move(sizes_);
  }

 private:
  Size of(ir::Block& block) {
    Size sum;
    for (size_t i = 0; i < block.size(); ++i) {
      const Size size = std::visit([&](auto& what) { return of(what, block, i); }, block[i].what);
      sum.instructions += size.instructions;
      sum.branches += size.branches;
      sum.work += size.work;
    }
    return sum;
  }
  Size of(const ir::Instruction& instruction, const ir::Block&, size_t) const {
    double numbers = 1;
    if (instruction.op == ir::Op::clear || instruction.op == ir::Op::copy)
      numbers = length(instruction.array);
    return {.instructions = 1, .work = numbers};
  }
  // Frames of called functions use the same memory behind the caller's frame, one call after the other.
  Size of(const ir::Call& call, const ir::Block&, size_t) {
    Size size = sizes_[call.function];
    most_called_ = std::max(most_called_, size.memory);
    size.work += 1;
    for (const ir::Slot& argument : call.arguments)
      size.work += argument.is_array ? length(argument.array) : double(argument.numbers.size());
    size.memory = 0;
    return size;
  }
  Size of(ir::Branch& branch, const ir::Block&, size_t) {
    const Size yes = of(branch.yes), no = of(branch.no);
    return {.instructions = 1 + yes.instructions + no.instructions,
            .branches = 1 + yes.branches + no.branches,
            .work = 1 + yes.work + no.work};
  }
  Size of(ir::Loop& loop, const ir::Block& around, size_t at) {
    const Size body = of(loop.body), next = of(loop.next);
    const double iteration = 1 + body.work + next.work;
    const auto known = known_iterations(loop, around, at);
    const bool uncounted = known && double(*known) * iteration <= most_uncounted_work;
    loop.iterations = uncounted ? std::max(*known, 1u) : 0;
    loop.weight = uint32_t(std::min(1 + iteration / work_of_an_iteration, 1e6));
    if (!uncounted) program_.counts_iterations = true;
    return {.instructions = 1 + body.instructions + next.instructions,
            .branches = 1 + body.branches + next.branches,
            .work = uncounted ? (*known + 1) * iteration : iteration};
  }
  Size of(const ir::Jump&, const ir::Block&, size_t) const { return {.instructions = 1, .work = 1}; }

  double length(ir::ArrayId id) const {
    return id < 0 ? double(program_.tables[size_t(~id)].bits.size()) : function_->arrays[size_t(id)].length;
  }
  std::optional<int64_t> known(ir::Operand operand) const {
    if (operand >= 0) return std::nullopt;
    return int32_t(program_.constants[size_t(~operand)].bits);
  }
  std::optional<uint32_t> known_iterations(const ir::Loop& loop, const ir::Block& around, size_t at) const;
  static size_t writes(const ir::Block& block, ir::Operand to);

  ir::Program& program_;
  const ir::Function* function_ = nullptr;
  std::vector<Size> sizes_;
  double most_called_ = 0;
};

// The number of instructions and calls that write to the register `to`.
size_t Measure::writes(const ir::Block& block, ir::Operand to) {
  size_t count = 0;
  const auto is_in = [to](const ir::Slot& slot) {
    return !slot.is_array && std::ranges::find(slot.numbers, to) != slot.numbers.end();
  };
  for (const ir::Statement& statement : block) {
    if (const auto* instruction = std::get_if<ir::Instruction>(&statement.what)) {
      const bool to_memory = instruction->op == ir::Op::store || instruction->op == ir::Op::clear ||
                             instruction->op == ir::Op::copy;
      count += !to_memory && instruction->to == to;
    } else if (const auto* call = std::get_if<ir::Call>(&statement.what)) {
      // A function may write to a register that is its argument.
      count += is_in(call->result) || std::ranges::any_of(call->arguments, is_in);
    } else if (const auto* branch = std::get_if<ir::Branch>(&statement.what)) {
      count += writes(branch->yes, to) + writes(branch->no, to);
    } else if (const auto* loop = std::get_if<ir::Loop>(&statement.what)) {
      count += writes(loop->body, to) + writes(loop->next, to);
    }
  }
  return count;
}

// The number of iterations of a loop for (int i = FROM; i < TO; i += STEP), or with <=; nothing for others.
// The register i must be set to a constant just before the loop, be compared first in each iteration, and be
// written to by the step alone.
std::optional<uint32_t> Measure::known_iterations(const ir::Loop& loop, const ir::Block& around,
                                                  size_t at) const {
  if (loop.body.size() < 2 || loop.next.empty() || at == 0) return std::nullopt;

  // The condition, and the jump out of the loop where it does not hold.
  size_t test = 0;
  const auto* compare = std::get_if<ir::Instruction>(&loop.body[test].what);
  const auto* opposite = std::get_if<ir::Instruction>(&loop.body[test + 1].what);
  const bool inclusive =
      opposite && compare && opposite->op == ir::Op::opposite && opposite->from[0] == compare->to;
  const size_t after = inclusive ? test + 2 : test + 1;
  if (after >= loop.body.size()) return std::nullopt;
  const auto* branch = std::get_if<ir::Branch>(&loop.body[after].what);
  if (!compare || compare->op != ir::Op::signed_less || !branch) return std::nullopt;
  if (branch->condition != (inclusive ? opposite->to : compare->to) || !branch->yes.empty() ||
      branch->no.size() != 1)
    return std::nullopt;
  const auto* leave = std::get_if<ir::Jump>(&branch->no[0].what);
  if (!leave || *leave != ir::Jump::leave) return std::nullopt;
  const ir::Operand i = compare->from[inclusive ? 1 : 0];  // !(TO < i) is i <= TO
  const auto to = known(compare->from[inclusive ? 0 : 1]);

  // The step, and the start.
  const auto* step = std::get_if<ir::Instruction>(&loop.next.back().what);
  if (i < 0 || !to || !step || step->op != ir::Op::whole_add || step->to != i || step->from[0] != i)
    return std::nullopt;
  const auto by = known(step->from[1]);
  if (!by || *by < 1 || writes(loop.body, i) + writes(loop.next, i) != 1) return std::nullopt;
  std::optional<int64_t> from;
  for (size_t k = at; k-- > 0;) {
    const auto* start = std::get_if<ir::Instruction>(&around[k].what);
    if (!start) break;
    if (start->op == ir::Op::store || start->op == ir::Op::clear || start->op == ir::Op::copy ||
        start->to != i)
      continue;
    if (start->op == ir::Op::move) from = known(start->from[0]);
    break;
  }
  if (!from) return std::nullopt;
  const int64_t end = inclusive ? *to + 1 : *to;
  const int64_t iterations = std::max<int64_t>((end - *from + *by - 1) / *by, 0);
  if (end <= *from) return 0;
  if (*from + iterations * *by > INT32_MAX || iterations > (1 << 20)) return std::nullopt;
  return uint32_t(iterations);
}

// Sizes are sums that can double with each call. The sums that occur here do not overflow a double.
std::string too_much(std::string_view what, double found, double most) {
  return found <= most
             ? ""
             : fmt::format("with the functions that it calls the formula has {}; at most {:.0f} are allowed",
                           found < 1e9 ? fmt::format("{:.0f} {}", found, what)
                                       : fmt::format("{:.1e} {}", found, what),
                           most);
}

}  // namespace

std::string limit(ir::Program& program) {
  const std::vector<Size> sizes = Measure(program).run();
  double tables = 0;
  for (const ir::Table& table : program.tables) tables += double(table.bits.size());
  if (std::string why = too_much("numbers in constant arrays", tables, most_memory); !why.empty()) return why;
  for (const Size& size : sizes) {
    if (std::string why = too_much("instructions", size.instructions, most_instructions); !why.empty())
      return why;
    if (std::string why = too_much("branches and loops", size.branches, most_branches); !why.empty())
      return why;
    if (std::string why = too_much("numbers in arrays", size.memory, most_memory); !why.empty()) return why;
    if (std::string why = too_much("instructions to carry out", size.work, most_work); !why.empty())
      return why;
  }
  return "";
}

Size size_of(const ir::Program& program) {
  ir::Program copy = program;
  const std::vector<Size> sizes = Measure(copy).run();
  Size sum = sizes[program.value];
  for (const uint32_t other : program.other) {
    sum.instructions += sizes[other].instructions;
    sum.branches += sizes[other].branches;
  }
  return sum;
}

}  // namespace eyeray::engine::formula
