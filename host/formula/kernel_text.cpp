#include "host/formula/kernel_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/core/error.hpp"

namespace eyeray::engine::formula {

namespace {

using ir::Op;

std::string_view name_of(ir::Type type) {
  return type == ir::Type::real ? "float" : type == ir::Type::whole ? "uint" : "bool";
}

// A literal of this type. A float is written as its bits: compilers would fold a decimal, in float64.
std::string literal(ir::Type type, uint32_t bits) {
  if (type == ir::Type::real) return fmt::format("uintBitsToFloat(0x{:08x}u)", bits);
  if (type == ir::Type::whole) return fmt::format("{}u", bits);
  return bits ? "true" : "false";
}

// The GLSL of the operation, with {0}, {1}, {2} for its operands.
std::string_view pattern(Op op) {
  switch (op) {
    case Op::move:
      return "{0}";
    case Op::negate:
      return "-{0}";
    case Op::add:
      return "{0} + {1}";
    case Op::subtract:
      return "{0} - {1}";
    case Op::multiply:
      return "{0} * {1}";
    case Op::divide:
      return "{0} / {1}";
    case Op::absolute:
      return "fn_abs({0})";
    case Op::sign:
      return "fn_sign({0})";
    case Op::floor:
      return "fn_floor({0})";
    case Op::ceil:
      return "fn_ceil({0})";
    case Op::trunc:
      return "fn_trunc({0})";
    case Op::round:
      return "fn_round({0})";
    case Op::fract:
      return "fn_fract({0})";
    case Op::sqrt:
      return "fn_sqrt({0})";
    case Op::inversesqrt:
      return "fn_inversesqrt({0})";
    case Op::radians:
      return "fn_radians({0})";
    case Op::degrees:
      return "fn_degrees({0})";
    case Op::sin:
      return "fn_sin({0})";
    case Op::cos:
      return "fn_cos({0})";
    case Op::tan:
      return "fn_tan({0})";
    case Op::asin:
      return "fn_asin({0})";
    case Op::acos:
      return "fn_acos({0})";
    case Op::atan:
      return "fn_atan({0})";
    case Op::exp:
      return "fn_exp({0})";
    case Op::log:
      return "fn_log({0})";
    case Op::exp2:
      return "fn_exp2({0})";
    case Op::log2:
      return "fn_log2({0})";
    case Op::sinh:
      return "fn_sinh({0})";
    case Op::cosh:
      return "fn_cosh({0})";
    case Op::tanh:
      return "fn_tanh({0})";
    case Op::atan2:
      return "fn_atan({0}, {1})";
    case Op::pow:
      return "fn_pow({0}, {1})";
    case Op::min:
      return "fn_min({0}, {1})";
    case Op::max:
      return "fn_max({0}, {1})";
    case Op::mod:
      return "fn_mod({0}, {1})";
    case Op::step:
      return "fn_step({0}, {1})";
    case Op::clamp:
      return "fn_clamp({0}, {1}, {2})";
    case Op::mix:
      return "fn_mix({0}, {1}, {2})";
    case Op::smoothstep:
      return "fn_smoothstep({0}, {1}, {2})";
    case Op::less:
      return "{0} < {1}";
    case Op::less_equal:
      return "{0} <= {1}";
    case Op::equal:
      return "{0} == {1}";
    case Op::whole_negate:
      return "0u - {0}";
    case Op::whole_add:
      return "{0} + {1}";
    case Op::whole_subtract:
      return "{0} - {1}";
    case Op::whole_multiply:
      return "{0} * {1}";
    case Op::signed_divide:
      return "whole_divide({0}, {1})";
    case Op::unsigned_divide:
      return "natural_divide({0}, {1})";
    case Op::signed_remainder:
      return "whole_remainder({0}, {1})";
    case Op::unsigned_remainder:
      return "natural_remainder({0}, {1})";
    case Op::signed_modulo:
      return "whole_modulo({0}, {1})";
    case Op::bit_and:
      return "{0} & {1}";
    case Op::bit_or:
      return "{0} | {1}";
    case Op::bit_xor:
      return "{0} ^ {1}";
    case Op::bit_not:
      return "~{0}";
    case Op::shift_left:
      return "{0} << ({1} & 31u)";
    case Op::shift_right:
      return "{0} >> ({1} & 31u)";
    case Op::signed_shift_right:
      return "uint(int({0}) >> int({1} & 31u))";
    case Op::whole_equal:
      return "{0} == {1}";
    case Op::signed_less:
      return "int({0}) < int({1})";
    case Op::unsigned_less:
      return "{0} < {1}";
    case Op::clamp_index:
      return "clamped_index({0}, {1})";
    case Op::from_signed:
      return "float(int({0}))";
    case Op::from_unsigned:
      return "float({0})";
    case Op::to_signed:
      return "whole_of({0})";
    case Op::to_unsigned:
      return "natural_of({0})";
    case Op::both:
      return "{0} && {1}";
    case Op::either:
      return "{0} || {1}";
    case Op::opposite:
      return "!{0}";
    case Op::same:
      return "{0} == {1}";
    case Op::select:
      return "{0} ? {1} : {2}";
    case Op::load:
    case Op::store:
    case Op::clear:
    case Op::copy:
      break;
  }
  CHECK(false);
  return "";
}

class Writer {
 public:
  Writer(const ir::Program& program, FormulaKind kind, const std::string& name,
         expression::LoadedNumbers* numbers)
      : program_(program), kind_(kind), name_(name), numbers_(numbers) {}

  std::string run() {
    for (size_t i = 0; i < program_.tables.size(); ++i) write_table(i);
    for (size_t i = 0; i < program_.functions.size(); ++i) write_function(i);
    write_entry(entry_of(kind_), program_.value);
    for (const uint32_t other : program_.other) write_entry(other_entry_of(kind_), other);
    return std::move(text_);
  }

 private:
  template <typename... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    text_.append(2 * depth_, ' ');
    text_ += fmt::format(format, std::forward<Values>(values)...) + "\n";
  }
  void open(const std::string& head) {
    line("{} {{", head);
    ++depth_;
  }
  void close() {
    --depth_;
    line("}}");
  }

  void write_table(size_t i) {
    const ir::Table& table = program_.tables[i];
    std::vector<std::string> values;
    for (const uint32_t bits : table.bits) values.push_back(constant(table.type, bits));
    line("{0} {1}t{2}[{3}] = {0}[{3}]({4});", name_of(table.type), name_, i, table.bits.size(),
         fmt::join(values, ", "));
  }

  std::string constant(ir::Type type, uint32_t bits) {
    if (!numbers_ || type == ir::Type::truth) return literal(type, bits);
    return type == ir::Type::real ? numbers_->add_float(bits) : numbers_->add_uint(bits);
  }
  std::string operand(ir::Operand operand) {
    if (operand >= 0) return fmt::format("r{}", operand);
    const ir::Constant& known = program_.constants[size_t(~operand)];
    return constant(known.type, known.bits);
  }
  // An array's index. A constant index is not loaded: compilers keep an array in registers if they know its
  // indices.
  std::string array_index(ir::Operand operand) const {
    if (operand >= 0) return fmt::format("r{}", operand);
    return literal(ir::Type::whole, program_.constants[size_t(~operand)].bits);
  }
  std::string array(ir::ArrayId id) const {
    return id >= 0 ? fmt::format("a{}", id) : fmt::format("{}t{}", name_, ~id);
  }
  ir::Array array_of(ir::ArrayId id) const {
    return id >= 0 ? function_->arrays[size_t(id)]
                   : ir::Array{program_.tables[size_t(~id)].type,
                               uint32_t(program_.tables[size_t(~id)].bits.size())};
  }

  // Writes void NAMEi(parameters, results). All other registers and arrays are variables of the function.
  void write_function(size_t number) {
    function_ = &program_.functions[number];
    std::vector<std::string> parameters;
    std::vector<bool> is_parameter(function_->registers.size(), false);
    std::vector<bool> is_array_parameter(function_->arrays.size(), false);
    const auto declare = [&](const ir::Slot& slot, std::string_view direction) {
      if (slot.is_array) {
        const ir::Array& a = function_->arrays[size_t(slot.array)];
        parameters.push_back(fmt::format("{}{} a{}[{}]", direction, name_of(a.type), slot.array, a.length));
        is_array_parameter[size_t(slot.array)] = true;
      }
      for (const ir::Operand r : slot.numbers) {
        parameters.push_back(fmt::format("{}{} r{}", direction, name_of(function_->registers[size_t(r)]), r));
        is_parameter[size_t(r)] = true;
      }
    };
    for (const ir::Parameter& parameter : function_->parameters)
      declare(parameter.slot, parameter.written ? "inout " : "");
    declare(function_->result, "out ");
    open(fmt::format("void {}{}({})", name_, number, fmt::join(parameters, ", ")));
    for (size_t i = 0; i < function_->registers.size(); ++i)
      if (!is_parameter[i]) line("{} r{};", name_of(function_->registers[i]), i);
    for (size_t i = 0; i < function_->arrays.size(); ++i)
      if (!is_array_parameter[i])
        line("{} a{}[{}];", name_of(function_->arrays[i].type), i, function_->arrays[i].length);
    loops_ = 0;
    write(function_->body);
    close();
  }

  void write_entry(const Entry& entry, uint32_t number) {
    const ir::Function& function = program_.functions[number];
    open(fmt::format("{} {}{}({} p)", entry.type, name_, entry.name, entry.parameter));
    std::vector<std::string> arguments;
    for (uint32_t i = 0; i < function.input_count(); ++i) arguments.push_back(fmt::format("p.{}", "xyzw"[i]));
    const ir::Parameter& p = function.parameters[0];
    if (p.slot.is_array || p.written) {
      line("float q[{0}] = float[{0}]({1});", arguments.size(), fmt::join(arguments, ", "));
      for (size_t i = 0; i < arguments.size(); ++i) arguments[i] = fmt::format("q[{}]", i);
      if (p.slot.is_array) arguments = {"q"};
    }
    const bool in_array = function.result.is_array;
    const size_t count = in_array ? 1 : function.result.numbers.size();
    std::vector<std::string> results;
    for (size_t i = 0; i < count; ++i) {
      line("float v{};", i);
      results.push_back(fmt::format("v{}", i));
    }
    arguments.insert(arguments.end(), results.begin(), results.end());
    line("{}{}({});", name_, number, fmt::join(arguments, ", "));
    line("return {}({});", entry.type, fmt::join(results, ", "));
    close();
  }

  void write(const ir::Block& block) {
    for (const ir::Statement& statement : block)
      std::visit([&](const auto& what) { write(what); }, statement.what);
  }

  void write(const ir::Instruction& instruction) {
    const auto from = [&](size_t i) { return operand(instruction.from[i]); };
    switch (instruction.op) {
      case Op::load:
        line("r{} = {}[{}];", instruction.to, array(instruction.array), array_index(instruction.from[0]));
        return;
      case Op::store:
        line("{}[{}] = {};", array(instruction.array), array_index(instruction.from[0]), from(1));
        return;
      case Op::copy:
        line("{} = {};", array(instruction.array), array(instruction.other));
        return;
      case Op::clear: {
        const ir::Array a = array_of(instruction.array);
        line("for (uint i = 0u; i < {}u; i++) {}[i] = {};", a.length, array(instruction.array),
             literal(a.type, 0));
        return;
      }
      default:
        line("r{} = {};", instruction.to,
             fmt::format(fmt::runtime(pattern(instruction.op)), from(0), from(1), from(2)));
    }
  }

  void write(const ir::Call& call) {
    std::vector<std::string> arguments;
    const auto add = [&](const ir::Slot& slot) {
      if (slot.is_array) arguments.push_back(array(slot.array));
      for (const ir::Operand number : slot.numbers) arguments.push_back(operand(number));
    };
    for (const ir::Slot& slot : call.arguments) add(slot);
    add(call.result);
    line("{}{}({});", name_, call.function, fmt::join(arguments, ", "));
  }

  void write(const ir::Branch& branch) {
    const std::string condition = operand(branch.condition);
    open(fmt::format("if ({}{})", branch.yes.empty() ? "!" : "", condition));
    write(branch.yes.empty() ? branch.no : branch.yes);
    close();
    if (branch.yes.empty() || branch.no.empty()) return;
    open("else");
    write(branch.no);
    close();
  }

  // Writes loop.next at the end of the iteration. If the body may `continue`, it stands at the start of the
  // next iteration instead.
  void write(const ir::Loop& loop) {
    const bool jumps = has_next(loop.body) && !loop.next.empty();
    const size_t number = loops_++;
    if (jumps) line("bool again{} = false;", number);
    open("for (;;)");
    if (jumps) {
      open(fmt::format("if (again{})", number));
      write(loop.next);
      close();
      line("again{} = true;", number);
    }
    if (loop.iterations == 0) line("if (!formula_iterates({}u)) break;", loop.weight);
    write(loop.body);
    if (!jumps) write(loop.next);
    close();
  }
  static bool has_next(const ir::Block& block) {
    for (const ir::Statement& statement : block) {
      if (const auto* jump = std::get_if<ir::Jump>(&statement.what); jump && *jump == ir::Jump::next)
        return true;
      if (const auto* branch = std::get_if<ir::Branch>(&statement.what))
        if (has_next(branch->yes) || has_next(branch->no)) return true;
    }
    return false;
  }

  void write(const ir::Jump& jump) {
    line("{};", jump == ir::Jump::leave ? "break" : jump == ir::Jump::next ? "continue" : "return");
  }

  const ir::Program& program_;
  FormulaKind kind_;
  const std::string& name_;
  expression::LoadedNumbers* numbers_;  // null: constants stand in the text
  const ir::Function* function_ = nullptr;
  std::string text_;
  size_t depth_ = 0;
  size_t loops_ = 0;
};

}  // namespace

std::string kernel_text(const ir::Program& program, FormulaKind kind, const std::string& name,
                        expression::LoadedNumbers* numbers) {
  return Writer(program, kind, name, numbers).run();
}

}  // namespace eyeray::engine::formula
