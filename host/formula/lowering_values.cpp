// Lowers instructions that compute, and those that combine numbers.
#include <spirv/unified1/GLSL.std.450.h>

#include <algorithm>

#include "host/formula/lowering.hpp"

namespace eyeray::engine::formula {

namespace {

using ir::Op;

// The operation that a SPIR-V instruction performs on each component. `swaps`: its operands are in reverse
// order. `negates`: its result is the opposite of the operation's.
struct Row {
  spv::Op from;
  Op op;
  bool swaps = false, negates = false;
};
constexpr Row rows[] = {
    {spv::OpFNegate, Op::negate},
    {spv::OpFAdd, Op::add},
    {spv::OpFSub, Op::subtract},
    {spv::OpFMul, Op::multiply},
    {spv::OpFDiv, Op::divide},
    {spv::OpFMod, Op::mod},
    {spv::OpFOrdLessThan, Op::less},
    {spv::OpFOrdGreaterThan, Op::less, true},
    {spv::OpFOrdLessThanEqual, Op::less_equal},
    {spv::OpFOrdGreaterThanEqual, Op::less_equal, true},
    {spv::OpFOrdEqual, Op::equal},
    {spv::OpFUnordLessThan, Op::less_equal, true, true},
    {spv::OpFUnordGreaterThan, Op::less_equal, false, true},
    {spv::OpFUnordLessThanEqual, Op::less, true, true},
    {spv::OpFUnordGreaterThanEqual, Op::less, false, true},
    {spv::OpFUnordNotEqual, Op::equal, false, true},
    // glslang writes either instruction for GLSL's !=.
    {spv::OpFOrdNotEqual, Op::equal, false, true},
    {spv::OpSNegate, Op::whole_negate},
    {spv::OpIAdd, Op::whole_add},
    {spv::OpISub, Op::whole_subtract},
    {spv::OpIMul, Op::whole_multiply},
    {spv::OpSDiv, Op::signed_divide},
    {spv::OpUDiv, Op::unsigned_divide},
    {spv::OpSRem, Op::signed_remainder},
    {spv::OpUMod, Op::unsigned_remainder},
    {spv::OpSMod, Op::signed_modulo},
    {spv::OpBitwiseAnd, Op::bit_and},
    {spv::OpBitwiseOr, Op::bit_or},
    {spv::OpBitwiseXor, Op::bit_xor},
    {spv::OpNot, Op::bit_not},
    {spv::OpShiftLeftLogical, Op::shift_left},
    {spv::OpShiftRightLogical, Op::shift_right},
    {spv::OpShiftRightArithmetic, Op::signed_shift_right},
    {spv::OpIEqual, Op::whole_equal},
    {spv::OpINotEqual, Op::whole_equal, false, true},
    {spv::OpSLessThan, Op::signed_less},
    {spv::OpSGreaterThan, Op::signed_less, true},
    {spv::OpSLessThanEqual, Op::signed_less, true, true},
    {spv::OpSGreaterThanEqual, Op::signed_less, false, true},
    {spv::OpULessThan, Op::unsigned_less},
    {spv::OpUGreaterThan, Op::unsigned_less, true},
    {spv::OpULessThanEqual, Op::unsigned_less, true, true},
    {spv::OpUGreaterThanEqual, Op::unsigned_less, false, true},
    {spv::OpConvertSToF, Op::from_signed},
    {spv::OpConvertUToF, Op::from_unsigned},
    {spv::OpConvertFToS, Op::to_signed},
    {spv::OpConvertFToU, Op::to_unsigned},
    {spv::OpLogicalAnd, Op::both},
    {spv::OpLogicalOr, Op::either},
    {spv::OpLogicalNot, Op::opposite},
    {spv::OpLogicalEqual, Op::same},
    {spv::OpLogicalNotEqual, Op::same, false, true},
};

// GLSL's functions that are one ir::Op for each component.
constexpr std::pair<int, Op> functions[] = {
    {GLSLstd450FAbs, Op::absolute},   {GLSLstd450FSign, Op::sign},
    {GLSLstd450Floor, Op::floor},     {GLSLstd450Ceil, Op::ceil},
    {GLSLstd450Trunc, Op::trunc},     {GLSLstd450Round, Op::round},
    {GLSLstd450Fract, Op::fract},     {GLSLstd450Sqrt, Op::sqrt},
    {GLSLstd450Radians, Op::radians}, {GLSLstd450Degrees, Op::degrees},
    {GLSLstd450Sin, Op::sin},         {GLSLstd450Cos, Op::cos},
    {GLSLstd450Tan, Op::tan},         {GLSLstd450Asin, Op::asin},
    {GLSLstd450Acos, Op::acos},       {GLSLstd450Atan, Op::atan},
    {GLSLstd450Exp, Op::exp},         {GLSLstd450Log, Op::log},
    {GLSLstd450Exp2, Op::exp2},       {GLSLstd450Log2, Op::log2},
    {GLSLstd450Sinh, Op::sinh},       {GLSLstd450Cosh, Op::cosh},
    {GLSLstd450Tanh, Op::tanh},       {GLSLstd450InverseSqrt, Op::inversesqrt},
    {GLSLstd450Atan2, Op::atan2},     {GLSLstd450Pow, Op::pow},
    {GLSLstd450FMin, Op::min},        {GLSLstd450FMax, Op::max},
    {GLSLstd450Step, Op::step},       {GLSLstd450FClamp, Op::clamp},
    {GLSLstd450FMix, Op::mix},        {GLSLstd450SmoothStep, Op::smoothstep},
};

ir::Type result_type(Op op, ir::Type operand) {
  if (op == Op::less || op == Op::less_equal || op == Op::equal || op == Op::whole_equal ||
      op == Op::signed_less || op == Op::unsigned_less)
    return ir::Type::truth;
  if (op == Op::from_signed || op == Op::from_unsigned) return ir::Type::real;
  if (op == Op::to_signed || op == Op::to_unsigned) return ir::Type::whole;
  return operand;
}

}  // namespace

void FunctionLowering::lower_instruction(const Instruction& instruction, ir::Block& out) {
  if (lower_memory(instruction, out) || lower_composite(instruction, out)) return;
  if (instruction.op == spv::OpExtInst ? lower_function(instruction, out)
                                       : lower_arithmetic(instruction, out))
    return;
  refuse(instruction, fmt::format("instruction {} of SPIR-V is not supported here", int(instruction.op)));
}

ir::Operand FunctionLowering::apply(ir::Block& out, Op op, ir::Operand x, ir::Operand y, ir::Operand z) {
  const ir::Operand to = new_register(result_type(op, type_of(op == Op::select ? y : x)));
  out.push_back({ir::Instruction{.op = op, .to = to, .from = {x, y, z}}});
  return to;
}

void FunctionLowering::each(ir::Block& out, const Instruction& instruction, Op op,
                            const std::vector<ir::Slot>& from) {
  ir::Slot& result = values_[instruction.result];
  for (size_t i = 0; i < module_.type(instruction.type).size; ++i) {
    const auto part = [&](size_t k) -> ir::Operand {
      if (k >= from.size()) return 0;
      CHECK(!from[k].numbers.empty());  // no operation is applied to each element of an array
      return from[k].numbers[std::min(i, from[k].numbers.size() - 1)];
    };
    result.numbers.push_back(apply(out, op, part(0), part(1), part(2)));
  }
  computed_.insert(instruction.result);
}

ir::Operand FunctionLowering::sum_of_products(ir::Block& out, const ir::Slot& a, const ir::Slot& b) {
  ir::Operand sum = apply(out, Op::multiply, a.numbers[0], b.numbers[0]);
  for (size_t i = 1; i < a.numbers.size(); ++i)
    sum = apply(out, Op::add, sum, apply(out, Op::multiply, a.numbers[i], b.numbers[i]));
  return sum;
}

bool FunctionLowering::lower_arithmetic(const Instruction& instruction, ir::Block& out) {
  std::vector<ir::Slot> from;
  for (const uint32_t id : instruction.words) from.push_back(value(id));
  const auto row = std::ranges::find(rows, instruction.op, &Row::from);
  if (row != std::end(rows)) {
    if (row->swaps) std::swap(from[0], from[1]);
    each(out, instruction, row->op, from);
    if (!row->negates) return true;
    ir::Slot& result = values_[instruction.result];
    for (ir::Operand& number : result.numbers) number = apply(out, Op::opposite, number);
    if (result.numbers.size() > 1) computed_.erase(instruction.result);
    return true;
  }
  switch (instruction.op) {
    case spv::OpVectorTimesScalar:
      each(out, instruction, Op::multiply, from);
      return true;
    case spv::OpSelect:
      if (const Type& type = module_.type(instruction.type); type.op == spv::OpTypeArray) {
        const ir::Slot chosen = new_slot(type, true);
        ir::Branch branch{from[0].numbers[0], {}, {}};
        copy(chosen, from[1], branch.yes);
        copy(chosen, from[2], branch.no);
        out.push_back({std::move(branch)});
        values_[instruction.result] = chosen;
        return true;
      }
      each(out, instruction, Op::select, from);
      return true;
    case spv::OpDot:
      values_[instruction.result].numbers = {sum_of_products(out, from[0], from[1])};
      computed_.insert(instruction.result);
      return true;
    case spv::OpAll:
    case spv::OpAny: {
      ir::Operand all = from[0].numbers[0];
      for (size_t i = 1; i < from[0].numbers.size(); ++i)
        all = apply(out, instruction.op == spv::OpAll ? Op::both : Op::either, all, from[0].numbers[i]);
      values_[instruction.result].numbers = {all};
      return true;
    }
    default:
      return false;
  }
}

// Lowers a function of GLSL.std.450.
bool FunctionLowering::lower_function(const Instruction& instruction, ir::Block& out) {
  const uint32_t function = instruction.words[1];
  std::vector<ir::Slot> from;
  for (size_t i = 2; i < instruction.words.size(); ++i) from.push_back(value(instruction.words[i]));
  const auto row = std::ranges::find(functions, int(function), &std::pair<int, Op>::first);
  if (row != std::end(functions)) {
    each(out, instruction, row->second, from);
    return true;
  }

  ir::Slot& result = values_[instruction.result];
  const auto along = [&](Op op, const ir::Slot& a, ir::Operand b) {
    for (const ir::Operand number : a.numbers) result.numbers.push_back(apply(out, op, number, b));
    computed_.insert(instruction.result);
  };
  const auto length = [&](const ir::Slot& v) {
    return v.numbers.size() == 1 ? apply(out, Op::absolute, v.numbers[0])
                                 : apply(out, Op::sqrt, sum_of_products(out, v, v));
  };
  // The lesser or greater of two whole numbers, by the comparison `less`.
  const auto lesser = [&](Op less, ir::Operand x, ir::Operand y, bool greater) {
    return apply(out, Op::select, greater ? apply(out, less, x, y) : apply(out, less, y, x), y, x);
  };
  switch (function) {
    case GLSLstd450Length:
      result.numbers = {length(from[0])};
      return true;
    case GLSLstd450Distance: {
      ir::Slot difference;
      for (size_t i = 0; i < from[0].numbers.size(); ++i)
        difference.numbers.push_back(apply(out, Op::subtract, from[0].numbers[i], from[1].numbers[i]));
      result.numbers = {length(difference)};
      return true;
    }
    case GLSLstd450Normalize:
      along(Op::divide, from[0], length(from[0]));
      return true;
    case GLSLstd450Cross:
      for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const ir::Operand x = apply(out, Op::multiply, from[0].numbers[j], from[1].numbers[k]);
        const ir::Operand y = apply(out, Op::multiply, from[0].numbers[k], from[1].numbers[j]);
        result.numbers.push_back(apply(out, Op::subtract, x, y));
      }
      return true;
    case GLSLstd450Reflect: {
      const ir::Operand twice = apply(out, Op::multiply, real(2), sum_of_products(out, from[1], from[0]));
      for (size_t i = 0; i < from[0].numbers.size(); ++i)
        result.numbers.push_back(apply(out, Op::subtract, from[0].numbers[i],
                                       apply(out, Op::multiply, from[1].numbers[i], twice)));
      return true;
    }
    case GLSLstd450SAbs:
      for (const ir::Operand x : from[0].numbers)
        result.numbers.push_back(lesser(Op::signed_less, x, apply(out, Op::whole_negate, x), true));
      return true;
    case GLSLstd450SSign:
      for (const ir::Operand x : from[0].numbers) {
        const ir::Operand negative = apply(out, Op::signed_less, x, whole(0));
        const ir::Operand positive = apply(out, Op::signed_less, whole(0), x);
        result.numbers.push_back(apply(out, Op::select, negative, whole(~0u),
                                       apply(out, Op::select, positive, whole(1), whole(0))));
      }
      return true;
    case GLSLstd450SMin:
    case GLSLstd450SMax:
    case GLSLstd450UMin:
    case GLSLstd450UMax:
    case GLSLstd450SClamp:
    case GLSLstd450UClamp: {
      const bool is_signed =
          function == GLSLstd450SMin || function == GLSLstd450SMax || function == GLSLstd450SClamp;
      const Op less = is_signed ? Op::signed_less : Op::unsigned_less;
      const bool is_min = function == GLSLstd450SMin || function == GLSLstd450UMin;
      for (size_t i = 0; i < from[0].numbers.size(); ++i) {
        ir::Operand x = lesser(less, from[0].numbers[i], from[1].numbers[i], !is_min);
        if (from.size() == 3) x = lesser(less, x, from[2].numbers[i], false);
        result.numbers.push_back(x);
      }
      return true;
    }
    default:
      refuse(instruction, "this function is not supported here");
  }
}

bool FunctionLowering::lower_composite(const Instruction& instruction, ir::Block& out) {
  const std::vector<uint32_t>& words = instruction.words;
  const Type& type = module_.type(instruction.type);
  ir::Slot result;
  const auto element = [&](const ir::Slot& whole_value, uint32_t i) {
    if (whole_value.array < 0) {
      const ir::Table& table = program_.tables[size_t(~whole_value.array)];
      return constant(table.type, table.bits[i]);
    }
    const ir::Operand to = new_register(out_.arrays[size_t(whole_value.array)].type);
    out.push_back(
        {ir::Instruction{.op = Op::load, .to = to, .from = {whole(i)}, .array = whole_value.array}});
    return to;
  };
  const auto put = [&](uint32_t i, ir::Operand number) {
    out.push_back({ir::Instruction{.op = Op::store, .from = {whole(i), number}, .array = result.array}});
  };
  // Follows the literal indices from words[first] on to a member. Returns the index of its first number.
  const auto offset = [&](const Type& composite, size_t first) {
    const Type* t = &composite;
    uint32_t sum = 0;
    for (size_t i = first; i < words.size(); ++i) {
      const Type& member = module_.type(t->members[0]);
      sum += std::min(words[i], uint32_t(t->members.size()) - 1) * member.size;
      t = &member;
    }
    return sum;
  };
  switch (instruction.op) {
    case spv::OpCompositeConstruct:
      if (type.op == spv::OpTypeArray) result = new_slot(type, true);
      for (uint32_t at = 0; const uint32_t id : words) {
        for (const ir::Operand number : value(id).numbers) {
          if (result.is_array)
            put(at++, number);
          else
            result.numbers.push_back(number);
        }
      }
      break;
    case spv::OpVectorShuffle: {
      const std::vector<ir::Operand> a = value(words[0]).numbers, b = value(words[1]).numbers;
      for (size_t i = 2; i < words.size(); ++i)
        result.numbers.push_back(words[i] < a.size()              ? a[words[i]]
                                 : words[i] - a.size() < b.size() ? b[words[i] - a.size()]
                                                                  : a[0]);
      break;
    }
    case spv::OpCompositeExtract: {
      const ir::Slot composite = value(words[0]);
      const uint32_t first = offset(module_.type_of(words[0]), 1);
      for (uint32_t i = first; i < first + type.size; ++i)
        result.numbers.push_back(composite.is_array ? element(composite, i) : composite.numbers[i]);
      break;
    }
    case spv::OpCompositeInsert: {
      const ir::Slot part = value(words[0]), composite = value(words[1]);
      const uint32_t first = offset(type, 2);
      if (composite.is_array) {
        result = new_slot(type, true);
        copy(result, composite, out);
        for (uint32_t i = 0; i < part.numbers.size(); ++i) put(first + i, part.numbers[i]);
      } else {
        result = composite;
        std::ranges::copy(part.numbers, result.numbers.begin() + first);
      }
      break;
    }
    case spv::OpVectorExtractDynamic: {
      const std::vector<ir::Operand> numbers = value(words[0]).numbers;
      const ir::Operand at =
          apply(out, Op::clamp_index, value(words[1]).numbers[0], whole(uint32_t(numbers.size())));
      ir::Operand chosen = numbers[0];
      for (uint32_t i = 1; i < numbers.size(); ++i)
        chosen = apply(out, Op::select, apply(out, Op::whole_equal, at, whole(i)), numbers[i], chosen);
      result.numbers = {chosen};
      break;
    }
    case spv::OpCopyObject:
    case spv::OpBitcast:
      result = value(words[0]);
      break;
    case spv::OpUndef:
      result = new_slot(type, type.op == spv::OpTypeArray);
      if (result.is_array) out.push_back({ir::Instruction{.op = Op::clear, .array = result.array}});
      for (const ir::Operand number : result.numbers) assign({number}, {constant(scalar(type), 0)}, out);
      break;
    case spv::OpPhi:
      if (type.op == spv::OpTypeArray) refuse(instruction, "a condition cannot choose between arrays");
      if (!values_.contains(instruction.result)) values_[instruction.result] = new_slot(type, false);
      return true;
    default:
      return false;
  }
  values_[instruction.result] = std::move(result);
  return true;
}

}  // namespace eyeray::engine::formula
