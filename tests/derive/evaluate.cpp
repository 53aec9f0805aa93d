#include "derive/evaluate.hpp"

#undef SHADER_BEGIN
#undef SHADER_END
#define SHADER_BEGIN         \
  namespace eyeray::shader { \
  namespace {
#define SHADER_END \
  }                \
  }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "dual.glsl"
#include "enclosure_march.glsl"
#pragma GCC diagnostic pop

namespace eyeray::test {
namespace {

using derive::Op;

// One step by the functions `prefix`_…; constants, inputs and truths are the caller's.
#define EVALUATE(prefix, step, number, truth)                        \
  switch ((step).op) {                                               \
    case Op::negate:                                                 \
      number = prefix##_negate(x);                                   \
      break;                                                         \
    case Op::add:                                                    \
      number = prefix##_add(x, y);                                   \
      break;                                                         \
    case Op::subtract:                                               \
      number = prefix##_subtract(x, y);                              \
      break;                                                         \
    case Op::multiply:                                               \
      number = prefix##_multiply(x, y);                              \
      break;                                                         \
    case Op::scale:                                                  \
      number = prefix##_scale(float(tape.value((step).from[0])), y); \
      break;                                                         \
    case Op::square:                                                 \
      number = prefix##_square(x);                                   \
      break;                                                         \
    case Op::reciprocal:                                             \
      number = prefix##_reciprocal(x);                               \
      break;                                                         \
    case Op::absolute:                                               \
      number = prefix##_absolute(x);                                 \
      break;                                                         \
    case Op::minimum:                                                \
      number = prefix##_minimum(x, y);                               \
      break;                                                         \
    case Op::maximum:                                                \
      number = prefix##_maximum(x, y);                               \
      break;                                                         \
    case Op::square_root:                                            \
      number = prefix##_square_root(x);                              \
      break;                                                         \
    case Op::power:                                                  \
      number = prefix##_power(x, float((step).value));               \
      break;                                                         \
    case Op::sine:                                                   \
      number = prefix##_sine(x);                                     \
      break;                                                         \
    case Op::cosine:                                                 \
      number = prefix##_cosine(x);                                   \
      break;                                                         \
    case Op::exponential:                                            \
      number = prefix##_exponential(x);                              \
      break;                                                         \
    case Op::logarithm:                                              \
      number = prefix##_logarithm(x);                                \
      break;                                                         \
    case Op::angle:                                                  \
      number = prefix##_angle(x, y);                                 \
      break;                                                         \
    case Op::floor:                                                  \
      number = prefix##_floor(x);                                    \
      break;                                                         \
    case Op::choose:                                                 \
      number = prefix##_choose(c, y, z);                             \
      break;                                                         \
    case Op::less:                                                   \
      truth = prefix##_less(x, y);                                   \
      break;                                                         \
    case Op::less_equal:                                             \
      truth = prefix##_less_equal(x, y);                             \
      break;                                                         \
    case Op::equal:                                                  \
      truth = prefix##_equal(x, y);                                  \
      break;                                                         \
    case Op::both:                                                   \
      truth = prefix##_both(c, b);                                   \
      break;                                                         \
    case Op::either:                                                 \
      truth = prefix##_either(c, b);                                 \
      break;                                                         \
    case Op::opposite:                                               \
      truth = prefix##_opposite(c);                                  \
      break;                                                         \
    default:                                                         \
      break;                                                         \
  }

template <typename T>
T operand(const std::vector<T>& values, derive::Term term) {
  return term == derive::no_term ? T{} : values[size_t(term)];
}

}  // namespace

double evaluate(const derive::Tape& tape, derive::Term result, const Vec3& p) {
  std::vector<double> values;
  for (const derive::Step& step : tape.steps()) {
    double& value = values.emplace_back(step.value);
    if (step.op == Op::input) value = p[int(step.value)];
    if (step.op == Op::constant || step.op == Op::truth || step.op == Op::input) continue;
    value = derive::compute(step.op, operand(values, step.from[0]),
                            step.op == Op::power ? step.value : operand(values, step.from[1]),
                            operand(values, step.from[2]));
  }
  return values[size_t(result)];
}

shader::vec3 enclose(const derive::Tape& tape, derive::Term result, const shader::vec3& o,
                     const shader::vec3& d, float m, float h) {
  std::vector<shader::vec3> numbers;
  std::vector<shader::uint> truths;
  for (const derive::Step& step : tape.steps()) {
    const shader::vec3 x = operand(numbers, step.from[0]), y = operand(numbers, step.from[1]),
                       z = operand(numbers, step.from[2]);
    const shader::uint c = operand(truths, step.from[0]), b = operand(truths, step.from[1]);
    shader::vec3 number{};
    shader::uint truth = 0;
    EVALUATE(shader::enclosure, step, number, truth)
    if (step.op == Op::constant)
      number = {float(step.value), 0, float(step.error + std::abs(step.value - double(float(step.value))))};
    if (step.op == Op::input)
      number = shader::enclosure_of_coordinate(o[int(step.value)], d[int(step.value)], m, h);
    if (step.op == Op::truth) truth = step.value != 0 ? TRUTH_YES : TRUTH_NO;
    numbers.push_back(number);
    truths.push_back(truth);
  }
  return numbers[size_t(result)];
}

shader::vec4 differentiate(const derive::Tape& tape, derive::Term result, const shader::vec3& p) {
  std::vector<shader::vec4> numbers;
  std::vector<char> truths;
  for (const derive::Step& step : tape.steps()) {
    const shader::vec4 x = operand(numbers, step.from[0]), y = operand(numbers, step.from[1]),
                       z = operand(numbers, step.from[2]);
    const bool c = operand(truths, step.from[0]) != 0, b = operand(truths, step.from[1]) != 0;
    shader::vec4 number{};
    bool truth = false;
    EVALUATE(shader::dual, step, number, truth)
    const int axis = step.op == Op::input ? int(step.value) : -1;
    if (step.op == Op::constant) number = {0, 0, 0, float(step.value)};
    if (axis >= 0) number = {axis == 0, axis == 1, axis == 2, p[axis]};
    if (step.op == Op::truth) truth = step.value != 0;
    numbers.push_back(number);
    truths.push_back(truth);
  }
  return numbers[size_t(result)];
}

FirstRoot march(const derive::Tape& tape, derive::Term result, const shader::vec3& o, const shader::vec3& d,
                float start, float end, float finest, int most) {
  shader::March march = shader::march_begin(start, end, finest);
  int steps = 0;
  for (; steps < most && !march.over; ++steps)
    march = shader::march_on(
        march, enclose(tape, result, o, d, shader::march_middle(march), shader::march_half(march)));
  return {march.found ? march.root : -1, steps, march.over};
}

}  // namespace eyeray::test
