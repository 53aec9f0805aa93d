// A function that a user has written in GLSL. It defines a surface (as a function of a point in space), a
// colour (of a point on a surface) or a camera (of a point in the picture). Its text is untrusted: it is
// judged and compiled by glslang, and no executor runs it. Every executor runs the program made from its
// SPIR-V, with nothing undefined left (formula/ir.hpp). docs/formulas.md lists the allowed GLSL,
// docs/security.md the barriers against hostile text.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/expression/expression.hpp"
#include "host/expression/loaded_numbers.hpp"
#include "host/formula/entry.hpp"

namespace eyeray::engine::formula {

struct Compiled;
struct Text;

// The text as the user wrote it. `start` is the position of its first character; its line is 0 if that
// position is unknown.
struct FormulaText {
  std::string text;
  SourcePosition start;
};

// A constant of the formula: a float for one value, a vec2 … vec4 for more.
struct FormulaParameter {
  std::string name;
  std::vector<double> values;
  bool operator==(const FormulaParameter&) const = default;
};

class Formula {
 public:
  // Throws InputError with every fault, at its position. `title`: its name in messages, "the formula of
  // [[implicit]] at scene.toml:12".
  Formula(FormulaText text, std::vector<FormulaParameter> parameters, std::string title,
          FormulaKind kind = FormulaKind::surface);
  ~Formula();
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;

  FormulaKind kind() const { return kind_; }
  const std::string& title() const { return title_; }
  const FormulaText& text() const { return text_; }
  // True if kind, text and parameters are the same as the other formula's.
  bool same(const Formula& other) const;
  // True if the text defines the optional second function (other_entry_of): a surface's gradient, a camera's
  // origin.
  bool has_other() const;
  // The position of that function's name, if the text never calls the function.
  const std::optional<SourcePosition>& uncalled_other() const { return uncalled_other_; }
  // The number of instructions if each call is replaced by the called function: a measure of the work of a
  // kernel's compiler.
  double instructions() const;

  // The formula as GLSL for kernels that have shaders/math/formula.glsl: the required function, for instance
  // `float NAMEf(vec3 p)`, and the text's other functions. Loops that must be counted (loops()) call `bool
  // formula_iterates(uint iterations)`. With `numbers`, constants are loaded: then formulas that differ only
  // in parameters mostly have the same text.
  std::string kernel(const std::string& name, expression::LoadedNumbers* numbers = nullptr) const;
  bool loops() const;

  // f as straight-line code, from which bounds and derivatives are made. Throws InputError, at the position
  // in the text, for code without such a form: loops whose number of iterations depends on p without a bound,
  // indices and whole numbers computed from p.
  const expression::StraightLine& straight_line() const;

  // The value of a surface's function, in float32 (with the bits that kernels compute) or in float64. Throws
  // Error (timed_out) if the loops take more iterations than FORMULA_ITERATIONS of math/formula.glsl.
  // Thread-safe. `iterations`, if given, grows by the number of iterations.
  float value(const std::array<float, 3>& p) const;
  double value(const std::array<double, 3>& p, uint64_t* iterations = nullptr) const;
  // The gradient by the text's own function; only if has_other().
  std::array<float, 3> gradient(const std::array<float, 3>& p) const;
  // The value of a colour's function; precision, errors and threads as for value().
  std::array<float, 3> color(const std::array<float, 2>& uv) const;
  std::array<double, 3> color(const std::array<double, 2>& uv) const;
  // Direction and origin of a camera's ray. `at`: a point in the picture, then a point on the lens. The
  // origin is 0 if the text does not define it.
  std::array<float, 3> direction(const std::array<float, 4>& at) const;
  std::array<double, 3> direction(const std::array<double, 4>& at) const;
  std::array<float, 3> origin(const std::array<float, 4>& at) const;
  std::array<double, 3> origin(const std::array<double, 4>& at) const;

 private:
  template <size_t Results, typename T, size_t Inputs>
  std::array<T, Results> run(const std::array<T, Inputs>& input, uint64_t* iterations = nullptr) const;
  template <typename T, size_t Inputs>
  std::array<T, 3> run_other(const std::array<T, Inputs>& input) const;
  [[noreturn]] void endless() const;
  std::vector<Diagnostic> in_text(const InputError& error, const Text& text) const;

  FormulaText text_;
  std::vector<FormulaParameter> parameters_;
  std::string title_;
  FormulaKind kind_;
  std::optional<SourcePosition> uncalled_other_;
  std::shared_ptr<const Compiled> compiled_;
  mutable std::once_flag straightened_;
  mutable expression::StraightLine straight_line_;
};

// True if a constant may have this name.
bool is_formula_name(const std::string& name);

// The message for a formula whose loops do not end.
std::string endless_formula(const std::string& title);

}  // namespace eyeray::engine::formula
