// A function of a few numbers as straight-line code: each step an operation on earlier ones, none of them
// twice. What is known beforehand is computed while it is written down. Other functions are derived from it
// step by step (emit.hpp).
#pragma once

#include <array>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace eyeray::engine::expression {

// Numbers are real, truths are yes or no; whole numbers are numbers.
enum class Op {
  constant,
  input,
  negate,
  add,
  subtract,
  multiply,
  scale,  // multiply by a constant without error
  square,
  reciprocal,
  absolute,
  minimum,
  maximum,
  square_root,
  power,  // of a number ≥ 0, the exponent being a constant > 0
  sine,
  cosine,
  exponential,
  logarithm,
  angle,  // of (second, first) in (−π, π]
  floor,
  choose,  // second or third, by a truth
  // truths
  truth,  // constant
  less,
  less_equal,
  equal,
  both,
  either,
  opposite,
};

std::string_view name(Op op);
bool is_truth(Op op);
int operands(Op op);

// A step's index.
using Term = int;
constexpr Term no_term = -1;

struct Step {
  Op op;
  std::array<Term, 3> from{no_term, no_term, no_term};
  double value = 0;  // of a constant or truth; which input; the factor of a scale, the exponent of a power
  double error = 0;  // error of a constant, of a decimal fraction for instance
};

class Expression {
 public:
  const std::vector<Step>& steps() const { return steps_; }
  const Step& step(Term t) const { return steps_[size_t(t)]; }

  // The term for a value or operation, simplified; an equal one is found again. Operands come first, so that
  // a loop over steps() computes.
  Term constant(double value, double error = 0);
  Term truth(bool value);
  Term input(int index);
  Term power(Term x, double exponent);
  Term apply(Op op, Term x, Term y = no_term, Term z = no_term);

  // True if it is a constant, number or truth, that value() has.
  bool known(Term t) const { return step(t).op == Op::constant || step(t).op == Op::truth; }
  double value(Term t) const { return step(t).value; }
  bool is(Term t, double value) const { return known(t) && this->value(t) == value && step(t).error == 0; }

 private:
  Term record(const Step& step);
  Term simplified(Op op, Term x, Term y, Term z);
  Term simplified_number(Op op, Term x, Term y, Term z);
  Term simplified_truth(Op op, Term x, Term y);
  Term folded(Op op, Term x, Term y);
  bool is_opposite(Term x, Term y) const;

  std::vector<Step> steps_;
  std::map<std::tuple<Op, Term, Term, Term, double, double>, Term> known_steps_;
};

// A number computed from p = inputs 0, 1, 2: steps of which the last is the result, and all are needed.
using StraightLine = std::vector<Step>;
StraightLine straight_line(const Expression& expression, Term result);

// The result of `op` for float64 operands; truths are 0 and 1. A scale's factor and a power's exponent is y.
// For the expression's own constants, and for tests.
double compute(Op op, double x, double y, double z);

}  // namespace eyeray::engine::expression
