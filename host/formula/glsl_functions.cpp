#include <spirv/unified1/GLSL.std.450.h>

#include <cmath>
#include <numbers>

#include "host/formula/arithmetic.hpp"

namespace eyeray::engine::formula {
namespace {

// Builds GLSL's functions from the few operations of an Expression.
class Formulas {
 public:
  explicit Formulas(Expression& expression) : expression_(expression) {}

  Term number(double x) { return expression_.constant(x); }
  // A number that floating point cannot hold exactly.
  Term fraction(double x) { return expression_.constant(x, 1e-15 * std::abs(x)); }
  Term add(Term x, Term y) { return expression_.apply(Op::add, x, y); }
  Term subtract(Term x, Term y) { return expression_.apply(Op::subtract, x, y); }
  Term multiply(Term x, Term y) { return expression_.apply(Op::multiply, x, y); }
  Term divide(Term x, Term y) { return multiply(x, expression_.apply(Op::reciprocal, y)); }
  Term of(Op op, Term x) { return expression_.apply(op, x); }
  Term half(Term x) { return multiply(number(0.5), x); }
  Term length(const Value& v) {
    return v.size() == 1 ? of(Op::absolute, v[0]) : of(Op::square_root, dot(expression_, v, v));
  }
  Term choose(Term condition, Term x, Term y) { return expression_.apply(Op::choose, condition, x, y); }
  Term less(Term x, Term y) { return expression_.apply(Op::less, x, y); }
  Term clamp(Term x, Term lower, Term upper) {
    return expression_.apply(Op::minimum, expression_.apply(Op::maximum, x, lower), upper);
  }

  Term sign(Term x) {
    return choose(less(x, number(0)), number(-1), choose(less(number(0), x), number(1), number(0)));
  }
  Term smooth_step(Term from, Term to, Term x) {
    const Term t = clamp(divide(subtract(x, from), subtract(to, from)), number(0), number(1));
    return multiply(of(Op::square, t), subtract(number(3), multiply(number(2), t)));
  }
  Term hyperbolic(Term x, Op op) {
    const Term up = of(Op::exponential, x), down = of(Op::exponential, of(Op::negate, x));
    return half(expression_.apply(op, up, down));
  }
  // Beyond ±16 tanh is ±1 to 1e-13, and e²ˣ would soon be more than bounds can hold.
  Term hyperbolic_tangent(Term x) {
    const Term e = of(Op::exponential, multiply(number(2), clamp(x, number(-16), number(16))));
    return subtract(number(1), divide(number(2), add(e, number(1))));
  }
  // √(1 − x²)
  Term complement(Term x) { return of(Op::square_root, subtract(number(1), of(Op::square, x))); }

  Term whole_power(Term x, int n) {
    if (n == 1) return x;
    const Term squared = of(Op::square, whole_power(x, n / 2 > 0 ? n / 2 : 1));
    return n % 2 == 0 ? squared : multiply(squared, x);
  }
  // If the exponent is whole, the power is a product, which is defined for negative x too, as in C++.
  Term power(Term x, Term y) {
    if (!expression_.known(y)) return of(Op::exponential, multiply(y, of(Op::logarithm, x)));
    const double n = expression_.value(y);
    if (n == 0) return number(1);
    const bool whole = n == std::round(n) && std::abs(n) <= 64;
    const Term positive = whole                ? whole_power(x, int(std::abs(n)))
                          : std::abs(n) == 0.5 ? of(Op::square_root, x)
                                               : expression_.power(x, std::abs(n));
    return n < 0 ? of(Op::reciprocal, positive) : positive;
  }

 private:
  Expression& expression_;
};

// Functions of one number.
std::optional<Term> of_one(Formulas& f, Expression& expression, uint32_t function, Term x) {
  switch (function) {
    case GLSLstd450FAbs:
      return f.of(Op::absolute, x);
    case GLSLstd450FSign:
      return f.sign(x);
    case GLSLstd450Floor:
      return f.of(Op::floor, x);
    case GLSLstd450Ceil:
      return f.of(Op::negate, f.of(Op::floor, f.of(Op::negate, x)));
    case GLSLstd450Trunc:
      return truncate(expression, x);
    case GLSLstd450Round:
    case GLSLstd450RoundEven:
      return f.of(Op::floor, f.add(x, f.number(0.5)));
    case GLSLstd450Fract:
      return f.subtract(x, f.of(Op::floor, x));
    case GLSLstd450Radians:
      return f.multiply(f.fraction(std::numbers::pi / 180), x);
    case GLSLstd450Degrees:
      return f.multiply(f.fraction(180 / std::numbers::pi), x);
    case GLSLstd450Sin:
      return f.of(Op::sine, x);
    case GLSLstd450Cos:
      return f.of(Op::cosine, x);
    case GLSLstd450Tan:
      return f.divide(f.of(Op::sine, x), f.of(Op::cosine, x));
    case GLSLstd450Asin:
      return expression.apply(Op::angle, x, f.complement(x));
    case GLSLstd450Acos:
      return expression.apply(Op::angle, f.complement(x), x);
    case GLSLstd450Atan:
      return expression.apply(Op::angle, x, f.number(1));
    case GLSLstd450Sinh:
      return f.hyperbolic(x, Op::subtract);
    case GLSLstd450Cosh:
      return f.hyperbolic(x, Op::add);
    case GLSLstd450Tanh:
      return f.hyperbolic_tangent(x);
    case GLSLstd450Exp:
      return f.of(Op::exponential, x);
    case GLSLstd450Exp2:
      return f.of(Op::exponential, f.multiply(f.fraction(std::numbers::ln2), x));
    case GLSLstd450Log:
      return f.of(Op::logarithm, x);
    case GLSLstd450Log2:
      return f.multiply(f.fraction(1 / std::numbers::ln2), f.of(Op::logarithm, x));
    case GLSLstd450Sqrt:
      return f.of(Op::square_root, x);
    case GLSLstd450InverseSqrt:
      return f.of(Op::reciprocal, f.of(Op::square_root, x));
    default:
      return std::nullopt;
  }
}

// Functions of two or three numbers, component by component.
std::optional<Term> of_more(Formulas& f, Expression& expression, uint32_t function, Term x, Term y, Term z) {
  switch (function) {
    case GLSLstd450Atan2:
      return expression.apply(Op::angle, x, y);
    case GLSLstd450Pow:
      return f.power(x, y);
    case GLSLstd450FMin:
    case GLSLstd450NMin:
    case GLSLstd450SMin:
    case GLSLstd450UMin:
      return expression.apply(Op::minimum, x, y);
    case GLSLstd450FMax:
    case GLSLstd450NMax:
    case GLSLstd450SMax:
    case GLSLstd450UMax:
      return expression.apply(Op::maximum, x, y);
    case GLSLstd450FClamp:
    case GLSLstd450NClamp:
    case GLSLstd450SClamp:
    case GLSLstd450UClamp:
      return f.clamp(x, y, z);
    case GLSLstd450FMix:
      return f.add(x, f.multiply(z, f.subtract(y, x)));
    case GLSLstd450Step:
      return f.choose(f.less(y, x), f.number(0), f.number(1));
    case GLSLstd450SmoothStep:
      return f.smooth_step(x, y, z);
    case GLSLstd450Fma:
      return f.add(f.multiply(x, y), z);
    default:
      return std::nullopt;
  }
}

// Functions of whole vectors.
std::optional<Value> of_vectors(Formulas& f, Expression& expression, uint32_t function,
                                const std::vector<Value>& from) {
  const Value& a = from[0];
  const auto along = [&](Term factor, const Value& v) {
    Value result;
    for (const Term x : v) result.push_back(f.multiply(factor, x));
    return result;
  };
  const auto minus = [&](const Value& x, const Value& y) {
    Value result;
    for (size_t i = 0; i < x.size(); ++i) result.push_back(f.subtract(x[i], y[i]));
    return result;
  };
  switch (function) {
    case GLSLstd450Length:
      return Value{f.length(a)};
    case GLSLstd450Distance:
      return Value{f.length(minus(a, from[1]))};
    case GLSLstd450Normalize:
      return along(expression.apply(Op::reciprocal, f.length(a)), a);
    case GLSLstd450Cross: {
      const Value& b = from[1];
      const auto component = [&](size_t i, size_t j) {
        return f.subtract(f.multiply(a[i], b[j]), f.multiply(a[j], b[i]));
      };
      return Value{component(1, 2), component(2, 0), component(0, 1)};
    }
    case GLSLstd450Reflect:
      return minus(a, along(f.multiply(f.number(2), dot(expression, from[1], a)), from[1]));
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<Value> glsl_function(Expression& expression, uint32_t function,
                                   const std::vector<Value>& from) {
  Formulas formulas(expression);
  if (std::optional<Value> whole = of_vectors(formulas, expression, function, from)) return whole;
  Value result;
  for (size_t i = 0; i < from[0].size(); ++i) {
    const auto at = [&](size_t k) { return k < from.size() ? from[k][i] : no_term; };
    const std::optional<Term> term = from.size() == 1
                                         ? of_one(formulas, expression, function, at(0))
                                         : of_more(formulas, expression, function, at(0), at(1), at(2));
    if (!term) return std::nullopt;
    result.push_back(*term);
  }
  return result;
}

}  // namespace eyeray::engine::formula
