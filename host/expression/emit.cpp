#include "host/expression/emit.hpp"

#include <fmt/format.h>

#include <cmath>

namespace eyeray::engine::expression {
namespace {

// The kind of number in which all steps are computed.
struct Kind {
  std::string_view prefix;  // prefix of the shader functions' names
  std::string_view number;
  std::string_view truth;
};
constexpr Kind bounds{"bound", "vec3", "uint"};
constexpr Kind duals{"dual", "vec4", "bool"};

std::string number(double x, LoadedNumbers* numbers) {
  return numbers ? numbers->add_float(float(x)) : fmt::format("{:.9e}f", x);
}

std::string constant(const Kind& kind, const Step& step, LoadedNumbers* numbers) {
  const std::string value = number(double(float(step.value)), numbers);
  return kind.number == "vec3"
             ? fmt::format("vec3({}, 0.0f, {})", value, number(double(constant_error(step)), numbers))
             : fmt::format("vec4(0.0f, 0.0f, 0.0f, {})", value);
}

std::string truth(const Kind& kind, bool yes) {
  return kind.truth == "bool" ? (yes ? "true" : "false") : (yes ? "TRUTH_YES" : "TRUTH_NO");
}

std::string lines(const StraightLine& line, const Kind& kind, const char* const (&inputs)[3],
                  LoadedNumbers* numbers) {
  std::string text;
  for (size_t i = 0; i < line.size(); ++i) {
    const Step& step = line[i];
    const auto from = [&](size_t k) { return fmt::format("v{}", step.from[k]); };
    std::string value;
    switch (step.op) {
      case Op::constant:
        value = constant(kind, step, numbers);
        break;
      case Op::truth:
        value = truth(kind, step.value != 0);
        break;
      case Op::input:
        value = inputs[size_t(step.value)];
        break;
      case Op::scale:
      case Op::power:
        value =
            fmt::format("{}_{}({}, {})", kind.prefix, name(step.op), from(0), number(step.value, numbers));
        break;
      default: {
        std::string arguments;
        for (size_t k = 0; k < size_t(operands(step.op)); ++k) arguments += (k == 0 ? "" : ", ") + from(k);
        value = fmt::format("{}_{}({})", kind.prefix, name(step.op), arguments);
      }
    }
    text += fmt::format("  {} v{} = {};\n", is_truth(step.op) ? kind.truth : kind.number, i, value);
  }
  return text + fmt::format("  return v{};\n", line.size() - 1);
}

}  // namespace

// Rounded up, so that the interval around the float contains the constant's interval.
float constant_error(const Step& step) {
  const double error = step.error + std::abs(step.value - double(float(step.value)));
  return error == 0 ? 0.0f : std::nextafter(float(error * (1 + 1e-6)), 1e38f);
}

std::string bound_text(const StraightLine& line, std::string_view name, LoadedNumbers* numbers) {
  return fmt::format("vec3 {}(vec3 x, vec3 y, vec3 z) {{\n{}}}\n", name,
                     lines(line, bounds, {"x", "y", "z"}, numbers));
}

std::string gradient_text(const StraightLine& line, std::string_view name, LoadedNumbers* numbers) {
  return fmt::format(
      "vec4 {}(vec3 p) {{\n{}}}\n", name,
      lines(line, duals,
            {"vec4(1.0f, 0.0f, 0.0f, p.x)", "vec4(0.0f, 1.0f, 0.0f, p.y)", "vec4(0.0f, 0.0f, 1.0f, p.z)"},
            numbers));
}

}  // namespace eyeray::engine::expression
