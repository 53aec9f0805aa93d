// A function of a few numbers as straight-line code. Each step is an operation on earlier steps, and no step
// occurs twice. Operations on constants are computed while the code is written. Other functions are derived
// from the code step by step (emit.hpp).
#pragma once

#include <array>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace eyeray::engine::expression {

// Operations on numbers, which are real, and on truths, which are yes or no. Whole numbers count as numbers.
enum class Op {
  constant,
  input,
  negate,
  add,
  subtract,
  multiply,
  scale,  // by a constant without error, which a float holds exactly
  square,
  reciprocal,
  absolute,
  minimum,
  maximum,
  square_root,
  power,  // the base is a number ≥ 0; the exponent is a constant > 0
  sine,
  cosine,
  exponential,
  logarithm,
  angle,  // atan2(first, second), in (−π, π]
  floor,
  choose,  // first ? second : third; the first is a truth
  // operations that result in truths
  truth,  // a constant truth
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
  double value = 0;  // value of a constant or truth; an input's index; a scale's factor; a power's exponent
  double error = 0;  // error of a constant, for instance of a decimal fraction
};

class Expression {
 public:
  const std::vector<Step>& steps() const { return steps_; }
  const Step& step(Term t) const { return steps_[size_t(t)]; }

  // The term for a value or operation, simplified; an equal term that exists already is returned. Operands
  // precede the steps that use them, so that one loop over steps() can compute them all.
  Term constant(double value, double error = 0);
  Term truth(bool value);
  Term input(int index);
  Term power(Term x, double exponent);
  Term apply(Op op, Term x, Term y = no_term, Term z = no_term);

  // True if the term is a constant number or truth, which value() then returns.
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

// The steps that compute a number from p = inputs 0, 1, 2. The last step is the result; all are needed.
using StraightLine = std::vector<Step>;
StraightLine straight_line(const Expression& expression, Term result);

// The result of `op` for float64 operands; truths are 0 and 1. y is a scale's factor or a power's exponent.
// Used for the expression's constants, and by tests.
double compute(Op op, double x, double y, double z);

}  // namespace eyeray::engine::expression
