#include "host/formula/arithmetic.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::formula {
namespace {

// Applies `op` to each component; y may be missing.
Value each(Expression& expression, Op op, const Value& x, const Value& y = {}) {
  Value result(x.size());
  for (size_t i = 0; i < x.size(); ++i) result[i] = expression.apply(op, x[i], y.empty() ? no_term : y[i]);
  return result;
}

Value times(Expression& expression, const Value& x, Term factor) {
  return each(expression, Op::multiply, x, Value(x.size(), factor));
}

Value opposite(Expression& expression, const Value& x) {
  return each(expression, Op::opposite, x);
}

Value select(Expression& expression, const Value& condition, const Value& x, const Value& y) {
  Value result(x.size());
  for (size_t i = 0; i < x.size(); ++i)
    result[i] = expression.apply(Op::choose, condition.size() == 1 ? condition[0] : condition[i], x[i], y[i]);
  return result;
}

// x − y·⌊x / y⌋, as GLSL's mod.
Value remainder(Expression& expression, const Value& x, const Value& y) {
  Value result(x.size());
  for (size_t i = 0; i < x.size(); ++i) {
    const Term quotient = expression.apply(Op::multiply, x[i], expression.apply(Op::reciprocal, y[i]));
    result[i] = expression.apply(Op::subtract, x[i],
                                 expression.apply(Op::multiply, y[i], expression.apply(Op::floor, quotient)));
  }
  return result;
}

// The product of a (rows × inner) and b (inner × columns), both stored column by column.
Value matrix_product(Expression& expression, const Value& a, const Value& b, size_t inner) {
  const size_t rows = a.size() / inner, columns = b.size() / inner;
  Value result;
  for (size_t column = 0; column < columns; ++column) {
    for (size_t row = 0; row < rows; ++row) {
      Value left, right;
      for (size_t i = 0; i < inner; ++i) {
        left.push_back(a[i * rows + row]);
        right.push_back(b[column * inner + i]);
      }
      result.push_back(dot(expression, left, right));
    }
  }
  return result;
}

Value transpose(const Value& matrix, size_t rows) {
  Value result;
  for (size_t row = 0; row < rows; ++row)
    for (size_t at = row; at < matrix.size(); at += rows) result.push_back(matrix[at]);
  return result;
}

Value all_of(Expression& expression, Op op, const Value& x) {
  Term result = x[0];
  for (size_t i = 1; i < x.size(); ++i) result = expression.apply(op, result, x[i]);
  return {result};
}

}  // namespace

Term dot(Expression& expression, const Value& a, const Value& b) {
  Term sum = expression.apply(Op::multiply, a[0], b[0]);
  for (size_t i = 1; i < a.size(); ++i)
    sum = expression.apply(Op::add, sum, expression.apply(Op::multiply, a[i], b[i]));
  return sum;
}

Term truncate(Expression& expression, Term x) {
  const Term up = expression.apply(Op::negate, expression.apply(Op::floor, expression.apply(Op::negate, x)));
  return expression.apply(Op::choose, expression.apply(Op::less, x, expression.constant(0)), up,
                          expression.apply(Op::floor, x));
}

std::optional<Value> arithmetic(Expression& expression, spv::Op op, const std::vector<Value>& from,
                                size_t size) {
  const auto at = [&](size_t i) -> const Value& { return from.at(i); };
  switch (op) {
    case spv::OpFNegate:
      return each(expression, Op::negate, at(0));
    case spv::OpFAdd:
      return each(expression, Op::add, at(0), at(1));
    case spv::OpFSub:
      return each(expression, Op::subtract, at(0), at(1));
    case spv::OpFMul:
      return each(expression, Op::multiply, at(0), at(1));
    case spv::OpFDiv:
      return each(expression, Op::multiply, at(0), each(expression, Op::reciprocal, at(1)));
    case spv::OpFMod:
      return remainder(expression, at(0), at(1));
    case spv::OpDot:
      return Value{dot(expression, at(0), at(1))};
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
      return times(expression, at(0), at(1)[0]);
    case spv::OpMatrixTimesVector:
      return matrix_product(expression, at(0), at(1), at(1).size());
    case spv::OpVectorTimesMatrix:
      return matrix_product(expression, at(0), at(1), at(0).size());
    case spv::OpMatrixTimesMatrix:
      return matrix_product(expression, at(0), at(1),
                            size_t(std::lround(std::sqrt(double(at(0).size() * at(1).size() / size)))));
    case spv::OpOuterProduct:
      return matrix_product(expression, at(0), at(1), 1);
    case spv::OpSelect:
      return select(expression, at(0), at(1), at(2));
    case spv::OpFOrdLessThan:
    case spv::OpFUnordLessThan:
      return each(expression, Op::less, at(0), at(1));
    case spv::OpFOrdGreaterThan:
    case spv::OpFUnordGreaterThan:
      return each(expression, Op::less, at(1), at(0));
    case spv::OpFOrdLessThanEqual:
    case spv::OpFUnordLessThanEqual:
      return each(expression, Op::less_equal, at(0), at(1));
    case spv::OpFOrdGreaterThanEqual:
    case spv::OpFUnordGreaterThanEqual:
      return each(expression, Op::less_equal, at(1), at(0));
    case spv::OpFOrdEqual:
    case spv::OpFUnordEqual:
      return each(expression, Op::equal, at(0), at(1));
    case spv::OpFOrdNotEqual:
    case spv::OpFUnordNotEqual:
      return opposite(expression, each(expression, Op::equal, at(0), at(1)));
    case spv::OpLogicalAnd:
      return each(expression, Op::both, at(0), at(1));
    case spv::OpLogicalOr:
      return each(expression, Op::either, at(0), at(1));
    case spv::OpLogicalNot:
      return opposite(expression, at(0));
    case spv::OpLogicalEqual:
      return select(expression, at(0), at(1), opposite(expression, at(1)));
    case spv::OpLogicalNotEqual:
      return select(expression, at(0), opposite(expression, at(1)), at(1));
    case spv::OpAll:
      return all_of(expression, Op::both, at(0));
    case spv::OpAny:
      return all_of(expression, Op::either, at(0));
    case spv::OpConvertSToF:
    case spv::OpConvertUToF:
      return at(0);
    case spv::OpTranspose:
      // Square matrices alone: `size` does not show the shape of others, such as 2×3, which are refused.
      if (const auto rows = size_t(std::lround(std::sqrt(double(size)))); rows * rows == size)
        return transpose(at(0), rows);
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<Value> whole_arithmetic(Expression& expression, spv::Op op, const std::vector<Value>& from,
                                      bool is_signed) {
  switch (op) {
    case spv::OpIEqual:
      return each(expression, Op::equal, from.at(0), from.at(1));
    case spv::OpINotEqual:
      return opposite(expression, each(expression, Op::equal, from.at(0), from.at(1)));
    case spv::OpSLessThan:
    case spv::OpULessThan:
      return each(expression, Op::less, from.at(0), from.at(1));
    case spv::OpSGreaterThan:
    case spv::OpUGreaterThan:
      return each(expression, Op::less, from.at(1), from.at(0));
    case spv::OpSLessThanEqual:
    case spv::OpULessThanEqual:
      return each(expression, Op::less_equal, from.at(0), from.at(1));
    case spv::OpSGreaterThanEqual:
    case spv::OpUGreaterThanEqual:
      return each(expression, Op::less_equal, from.at(1), from.at(0));
    default:
      break;
  }

  const auto compute_one = [op](int64_t x, int64_t y) -> std::optional<int64_t> {
    switch (op) {
      case spv::OpIAdd:
        return x + y;
      case spv::OpISub:
        return x - y;
      case spv::OpIMul:
        return int64_t(uint64_t(x) * uint64_t(y));
      case spv::OpSNegate:
        return -x;
      case spv::OpSDiv:
      case spv::OpUDiv:
        return y == 0 ? 0 : x / y;
      case spv::OpSRem:
      case spv::OpUMod:
        return y == 0 ? 0 : x % y;
      case spv::OpSMod:
        return y == 0 ? 0 : (x % y + y) % y;
      case spv::OpBitwiseAnd:
        return x & y;
      case spv::OpBitwiseOr:
        return x | y;
      case spv::OpBitwiseXor:
        return x ^ y;
      case spv::OpShiftLeftLogical:
        return int64_t(uint64_t(x) << (y & 31));
      case spv::OpShiftRightLogical:
        return int64_t(uint32_t(x) >> (y & 31));
      case spv::OpShiftRightArithmetic:
        return x >> (y & 31);
      case spv::OpNot:
        return ~x;
      case spv::OpBitcast:
        return x;
      case spv::OpConvertFToS:
        return x >= INT32_MIN && x <= INT32_MAX ? x : INT32_MIN;
      case spv::OpConvertFToU:
        return x >= 0 && x <= UINT32_MAX ? x : 0;
      default:
        return std::nullopt;
    }
  };
  Value result;
  for (size_t i = 0; i < from.at(0).size(); ++i) {
    const Term x = from[0][i], y = from.size() > 1 ? from[1][i] : x;
    if (!expression.known(x) || !expression.known(y) || !(std::abs(expression.value(x)) < 0x1p62))
      return std::nullopt;
    const std::optional<int64_t> whole =
        compute_one(int64_t(expression.value(x)), int64_t(expression.value(y)));
    if (!whole) return std::nullopt;
    result.push_back(
        expression.constant(is_signed ? double(int32_t(uint32_t(*whole))) : double(uint32_t(*whole))));
  }
  return result;
}

}  // namespace eyeray::engine::formula
