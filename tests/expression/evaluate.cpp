#include "tests/expression/evaluate.hpp"

#include "host/formula/formula.hpp"

#include "host/twin/straight_line.hpp"

#include "host/core/local_shaders.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "shaders/shapes/implicit/bound_march.glsl"
#pragma GCC diagnostic pop

namespace eyeray::engine::test {

expression::StraightLine straight_line(const std::string& glsl) {
  return formula::Formula({glsl, {"f.glsl", 10, 1}}, {}, "it").straight_line();
}

using expression::Op;

double evaluate(const expression::StraightLine& line, const Vec3& p) {
  std::vector<double> values;
  const auto operand = [&](expression::Term term) {
    return term == expression::no_term ? 0 : values[size_t(term)];
  };
  for (const expression::Step& step : line) {
    const bool given = step.op == Op::constant || step.op == Op::truth;
    const bool factor = step.op == Op::scale || step.op == Op::power;
    values.push_back(step.op == Op::input ? p[int(step.value)]
                     : given              ? step.value
                                          : expression::compute(step.op, operand(step.from[0]),
                                                   factor ? step.value : operand(step.from[1]),
                                                                operand(step.from[2])));
  }
  return values.back();
}

shader::vec3 bound_piece(const expression::StraightLine& line, const shader::vec3& o, const shader::vec3& d,
                         float m, float h) {
  return twin::affine_bound(line, shader::bound_of_coordinate(o.x, d.x, m, h),
                            shader::bound_of_coordinate(o.y, d.y, m, h),
                            shader::bound_of_coordinate(o.z, d.z, m, h));
}

FirstRoot march(const expression::StraightLine& line, const shader::vec3& o, const shader::vec3& d, float end,
                float finest, int most) {
  shader::March march = shader::march_begin(0, end, 0, finest);
  int steps = 0;
  for (; steps < most && !march.over; ++steps)
    march = shader::march_on(march,
                             bound_piece(line, o, d, shader::march_middle(march), shader::march_half(march)));
  return {march.found ? march.root : -1, steps, march.over};
}

}  // namespace eyeray::engine::test
