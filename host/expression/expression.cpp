#include "host/expression/expression.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"

namespace eyeray::engine::expression {
namespace {

struct Row {
  std::string_view name;
  int operands;
};
// One row for each Op, in their order. The names are those of the shader functions
// (shaders/math/affine_bound.glsl, shaders/math/dual.glsl).
constexpr Row rows[] = {
    {"constant", 0}, {"input", 0},       {"negate", 1},      {"add", 2},        {"subtract", 2},
    {"multiply", 2}, {"scale", 1},       {"square", 1},      {"reciprocal", 1}, {"absolute", 1},
    {"minimum", 2},  {"maximum", 2},     {"square_root", 1}, {"power", 1},      {"sine", 1},
    {"cosine", 1},   {"exponential", 1}, {"logarithm", 1},   {"angle", 2},      {"floor", 1},
    {"choose", 3},   {"truth", 0},       {"less", 2},        {"less_equal", 2}, {"equal", 2},
    {"both", 2},     {"either", 2},      {"opposite", 1},
};

}  // namespace

std::string_view name(Op op) {
  return rows[size_t(op)].name;
}
bool is_truth(Op op) {
  return op >= Op::truth;
}
int operands(Op op) {
  return rows[size_t(op)].operands;
}

double compute(Op op, double x, double y, double z) {
  switch (op) {
    case Op::negate:
      return -x;
    case Op::add:
      return x + y;
    case Op::subtract:
      return x - y;
    case Op::multiply:
    case Op::scale:
      return x * y;
    case Op::square:
      return x * x;
    case Op::reciprocal:
      return 1 / x;
    case Op::absolute:
      return std::abs(x);
    case Op::minimum:
      return std::min(x, y);
    case Op::maximum:
      return std::max(x, y);
    case Op::square_root:
      return std::sqrt(x);
    case Op::power:
      return std::pow(x, y);
    case Op::sine:
      return std::sin(x);
    case Op::cosine:
      return std::cos(x);
    case Op::exponential:
      return std::exp(x);
    case Op::logarithm:
      return std::log(x);
    case Op::angle:
      return std::atan2(x, y);
    case Op::floor:
      return std::floor(x);
    case Op::choose:
      return x != 0 ? y : z;
    case Op::less:
      return x < y;
    case Op::less_equal:
      return x <= y;
    case Op::equal:
      return x == y;
    case Op::both:
      return x != 0 && y != 0;
    case Op::either:
      return x != 0 || y != 0;
    case Op::opposite:
      return x == 0;
    case Op::constant:
    case Op::input:
    case Op::truth:
      break;
  }
  CHECK(false);
  return 0;
}

Term Expression::record(const Step& step) {
  const auto [at, fresh] = known_steps_.try_emplace(
      {step.op, step.from[0], step.from[1], step.from[2], step.value, step.error}, Term(steps_.size()));
  if (fresh) steps_.push_back(step);
  return at->second;
}

Term Expression::constant(double value, double error) {
  return record({.op = Op::constant, .value = value, .error = error});
}
Term Expression::truth(bool value) {
  return record({.op = Op::truth, .value = double(value)});
}
Term Expression::input(int index) {
  return record({.op = Op::input, .value = double(index)});
}

Term Expression::power(Term x, double exponent) {
  if (known(x)) return constant(std::pow(value(x), exponent), 1e-12 + step(x).error * std::abs(exponent));
  return record({.op = Op::power, .from = {x, no_term, no_term}, .value = exponent});
}

// The result of an operation on constants, with the error that follows from the constants' errors.
Term Expression::folded(Op op, Term x, Term y) {
  const double a = value(x), b = y == no_term ? 0 : value(y);
  const double ea = step(x).error, eb = y == no_term ? 0 : step(y).error;
  const double result = compute(op, a, b, 0);
  double error = 0;
  if (ea > 0 || eb > 0)
    for (const double from_a : {a - ea, a + ea})
      for (const double from_b : {b - eb, b + eb})
        error = std::max(error, std::abs(compute(op, from_a, from_b, 0) - result));
  // If a result is below 2^24 and a multiple of 1/256, exact operands give it no rounding error that counts.
  // Sums and products of whole numbers have no rounding error at all.
  const bool exact = std::abs(result) < 0x1p24 && result == std::round(result * 256) / 256;
  return constant(result, exact ? error : error * (1 + 1e-6) + 1e-15 * std::abs(result));
}

Term Expression::apply(Op op, Term x, Term y, Term z) {
  const Term simple = simplified(op, x, y, z);
  if (simple != no_term) return simple;
  // Operands are sorted if their order does not matter, so that a sum in another order is the same step.
  const bool commutes = op == Op::add || op == Op::multiply || op == Op::minimum || op == Op::maximum ||
                        op == Op::equal || op == Op::both || op == Op::either;
  if (commutes && y < x) std::swap(x, y);
  return record({.op = op, .from = {x, y, z}});
}

Term Expression::simplified(Op op, Term x, Term y, Term z) {
  if (op == Op::choose) {
    if (known(x)) return value(x) != 0 ? y : z;
    if (y == z) return y;
    if (step(x).op == Op::opposite) return apply(Op::choose, step(x).from[0], z, y);
    if (is_truth(step(y).op))
      return apply(Op::either, apply(Op::both, x, y), apply(Op::both, apply(Op::opposite, x), z));
    return no_term;
  }
  if (known(x) && (y == no_term || known(y))) {
    return is_truth(op) ? truth(compute(op, value(x), y == no_term ? 0 : value(y), 0) != 0)
                        : folded(op, x, y);
  }
  return is_truth(op) ? simplified_truth(op, x, y) : simplified_number(op, x, y, z);
}

Term Expression::simplified_number(Op op, Term x, Term y, Term) {
  switch (op) {
    case Op::add:
      if (is(x, 0)) return y;
      if (is(y, 0)) return x;
      if (step(y).op == Op::negate) return apply(Op::subtract, x, step(y).from[0]);
      if (step(x).op == Op::negate) return apply(Op::subtract, y, step(x).from[0]);
      return no_term;
    case Op::subtract:
      if (is(y, 0)) return x;
      if (is(x, 0)) return apply(Op::negate, y);
      if (x == y) return constant(0);
      if (step(y).op == Op::negate) return apply(Op::add, x, step(y).from[0]);
      return no_term;
    case Op::multiply: {
      if (known(y)) std::swap(x, y);
      if (is(x, 0)) return constant(0);
      if (is(x, 1)) return y;
      if (is(x, -1)) return apply(Op::negate, y);
      if (x == y) return apply(Op::square, x);
      if (known(x) && step(x).error == 0 && double(float(value(x))) == value(x))
        return record({.op = Op::scale, .from = {y, no_term, no_term}, .value = value(x)});
      return no_term;
    }
    case Op::negate:
      if (step(x).op == Op::negate) return step(x).from[0];
      if (step(x).op == Op::subtract) return apply(Op::subtract, step(x).from[1], step(x).from[0]);
      return no_term;
    case Op::square:
      if (step(x).op == Op::negate || step(x).op == Op::absolute) return apply(Op::square, step(x).from[0]);
      return no_term;
    case Op::absolute:
      if (step(x).op == Op::square || step(x).op == Op::square_root || step(x).op == Op::absolute) return x;
      if (step(x).op == Op::negate) return apply(Op::absolute, step(x).from[0]);
      return no_term;
    case Op::square_root:
      return step(x).op == Op::square ? apply(Op::absolute, step(x).from[0]) : no_term;
    case Op::minimum:
    case Op::maximum:
      return x == y ? x : no_term;
    default:
      return no_term;
  }
}

bool Expression::is_opposite(Term x, Term y) const {
  return (step(x).op == Op::opposite && step(x).from[0] == y) ||
         (step(y).op == Op::opposite && step(y).from[0] == x);
}

// After an if, the conditions of its two sides are joined again: (p and c) or (p and not c) is p.
Term Expression::simplified_truth(Op op, Term x, Term y) {
  if (op == Op::opposite) return step(x).op == Op::opposite ? step(x).from[0] : no_term;
  if (op != Op::both && op != Op::either) return no_term;
  const double neutral = op == Op::both ? 1 : 0;
  if (known(x)) return value(x) == neutral ? y : x;
  if (known(y)) return value(y) == neutral ? x : y;
  if (x == y) return x;
  if (is_opposite(x, y)) return truth(op == Op::either);
  if (op == Op::either && step(x).op == Op::both && step(y).op == Op::both) {
    for (const int i : {0, 1})
      for (const int j : {0, 1})
        if (step(x).from[size_t(i)] == step(y).from[size_t(j)] &&
            is_opposite(step(x).from[size_t(1 - i)], step(y).from[size_t(1 - j)]))
          return step(x).from[size_t(i)];
  }
  return no_term;
}

StraightLine straight_line(const Expression& expression, Term result) {
  std::vector<bool> needed(size_t(result) + 1);
  needed.back() = true;
  for (Term i = result; i >= 0; --i)
    if (needed[size_t(i)])
      for (const Term from : expression.step(i).from)
        if (from != no_term) needed[size_t(from)] = true;

  StraightLine line;
  std::vector<Term> renamed(needed.size(), no_term);
  for (size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i]) continue;
    renamed[i] = Term(line.size());
    Step& step = line.emplace_back(expression.step(Term(i)));
    for (Term& from : step.from)
      if (from != no_term) from = renamed[size_t(from)];
  }
  return line;
}

}  // namespace eyeray::engine::expression
