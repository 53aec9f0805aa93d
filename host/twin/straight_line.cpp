#include "host/twin/straight_line.hpp"

#include <vector>

#include "host/expression/emit.hpp"

#include "host/core/local_shaders.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "shaders/math/affine_bound.glsl"
#include "shaders/math/dual.glsl"
#pragma GCC diagnostic pop

namespace eyeray::engine::twin {
namespace {

using expression::Op;
using expression::Step;
using expression::StraightLine;

// A number or a truth. The step knows which of them it is.
template <typename Number, typename Truth>
struct Value {
  Number number;
  Truth truth;
};

// Executes a step by the functions prefix_…; the caller sets constants and inputs.
// clang-format off
#define STEP(prefix, step, x, y, z, result)                                                \
  switch ((step).op) {                                                                     \
    case Op::negate:      result.number = prefix##_negate(x.number); break;                \
    case Op::add:         result.number = prefix##_add(x.number, y.number); break;         \
    case Op::subtract:    result.number = prefix##_subtract(x.number, y.number); break;    \
    case Op::multiply:    result.number = prefix##_multiply(x.number, y.number); break;    \
    case Op::scale:       result.number = prefix##_scale(x.number, float((step).value)); break; \
    case Op::square:      result.number = prefix##_square(x.number); break;                \
    case Op::reciprocal:  result.number = prefix##_reciprocal(x.number); break;            \
    case Op::absolute:    result.number = prefix##_absolute(x.number); break;              \
    case Op::minimum:     result.number = prefix##_minimum(x.number, y.number); break;     \
    case Op::maximum:     result.number = prefix##_maximum(x.number, y.number); break;     \
    case Op::square_root: result.number = prefix##_square_root(x.number); break;           \
    case Op::power:       result.number = prefix##_power(x.number, float((step).value)); break; \
    case Op::sine:        result.number = prefix##_sine(x.number); break;                  \
    case Op::cosine:      result.number = prefix##_cosine(x.number); break;                \
    case Op::exponential: result.number = prefix##_exponential(x.number); break;           \
    case Op::logarithm:   result.number = prefix##_logarithm(x.number); break;             \
    case Op::angle:       result.number = prefix##_angle(x.number, y.number); break;       \
    case Op::floor:       result.number = prefix##_floor(x.number); break;                 \
    case Op::choose:      result.number = prefix##_choose(x.truth, y.number, z.number); break; \
    case Op::less:        result.truth = prefix##_less(x.number, y.number); break;         \
    case Op::less_equal:  result.truth = prefix##_less_equal(x.number, y.number); break;   \
    case Op::equal:       result.truth = prefix##_equal(x.number, y.number); break;        \
    case Op::both:        result.truth = prefix##_both(x.truth, y.truth); break;           \
    case Op::either:      result.truth = prefix##_either(x.truth, y.truth); break;         \
    case Op::opposite:    result.truth = prefix##_opposite(x.truth); break;                \
    case Op::constant: case Op::input: case Op::truth: break;                              \
  }
// clang-format on

// Room for the values of `count` steps. Each thread keeps its own, because it is needed millions of times.
template <typename T>
std::vector<T>& values(size_t count) {
  thread_local std::vector<T> all;
  if (all.size() < count) all.resize(count);
  return all;
}

template <typename T>
const T& operand(const std::vector<T>& all, const Step& step, size_t k) {
  return all[step.from[k] == expression::no_term ? 0 : size_t(step.from[k])];
}

}  // namespace

shader::vec3 affine_bound(const StraightLine& line, const shader::vec3& x, const shader::vec3& y,
                          const shader::vec3& z) {
  auto& all = values<Value<shader::vec3, shader::uint>>(line.size());
  for (size_t i = 0; i < line.size(); ++i) {
    const Step& step = line[i];
    auto& result = all[i];
    STEP(shader::bound, step, operand(all, step, 0), operand(all, step, 1), operand(all, step, 2), result)
    if (step.op == Op::constant) result.number = {float(step.value), 0, expression::constant_error(step)};
    if (step.op == Op::input) result.number = step.value == 0 ? x : step.value == 1 ? y : z;
    if (step.op == Op::truth) result.truth = step.value != 0 ? TRUTH_YES : TRUTH_NO;
  }
  return all[line.size() - 1].number;
}

shader::vec4 differentiate(const StraightLine& line, const shader::vec3& p) {
  auto& all = values<Value<shader::vec4, bool>>(line.size());
  for (size_t i = 0; i < line.size(); ++i) {
    const Step& step = line[i];
    auto& result = all[i];
    STEP(shader::dual, step, operand(all, step, 0), operand(all, step, 1), operand(all, step, 2), result)
    if (step.op == Op::constant) result.number = {0, 0, 0, float(step.value)};
    if (step.op == Op::truth) result.truth = step.value != 0;
    if (step.op == Op::input) {
      const int axis = int(step.value);
      result.number = {axis == 0, axis == 1, axis == 2, p[axis]};
    }
  }
  return all[line.size() - 1].number;
}

}  // namespace eyeray::engine::twin
