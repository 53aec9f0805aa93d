// A scalar function of a point that a user has written in GLSL: checked, as GLSL for kernels, and as machine
// code in float32 and float64. docs/implicit-surfaces.md says which GLSL.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"

namespace eyeray {

namespace formula {
struct Program;
class CppLibrary;
}  // namespace formula

// The text as a person wrote it, and where: `start` is the place of its first character. Without a line (0)
// nobody knows.
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
  // InputError with every fault that can be seen without a compiler. `title`: for messages, "the formula of
  // [[implicit]] at scene.toml:12".
  Formula(FormulaText text, std::vector<FormulaParameter> parameters, std::string title);
  ~Formula();
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;

  const std::string& title() const { return title_; }
  const FormulaText& text() const { return text_; }
  // Whether it is the same function as the other one.
  bool same(const Formula& other) const;

  // ---- As GLSL ----
  // Declarations of the parameters, to stand before the text as it was written.
  std::string declarations() const;
  // For a compiler to judge: constants, then from line 1 of a file of its own the text. Both with names of
  // their own.
  struct Checkable {
    std::string constants, text;
  };
  Checkable checkable() const;
  // What a compiler said of Checkable::text as said of the user's text.
  Diagnostic in_user_text(Diagnostic diagnostic) const;
  // Whether the text has a `vec3 gradient(vec3 p)` too.
  bool has_gradient() const;
  // `float NAMEf(vec3 p)` and what it needs, with NAME before every name. Loops ask `bool formula_turn()`, if
  // there are any that must (loops()).
  std::string kernel(const std::string& name) const;
  bool loops() const;

  // ---- As machine code ----
  // Done once, by whoever comes first. Error (no_compiler) where there is no C++ compiler, or it refuses the
  // text. Only for a text that a GLSL compiler has found right. Thread-safe, as are the values.
  void compile() const;
  // Error as compile()'s; and (timed_out) where the loops make more turns than FORMULA_TURNS of formula.glsl.
  float value(const std::array<float, 3>& p) const;
  double value(const std::array<double, 3>& p) const;
  // The text's own, if it has one.
  std::array<float, 3> gradient(const std::array<float, 3>& p) const;

 private:
  [[noreturn]] void endless() const;

  FormulaText text_;
  std::vector<FormulaParameter> parameters_;
  std::string title_;
  std::unique_ptr<const formula::Program> program_;
  mutable std::once_flag compiled_;
  mutable std::shared_ptr<const formula::CppLibrary> library_;
  mutable int (*value32_)(float, float, float, float*) = nullptr;
  mutable int (*gradient32_)(float, float, float, float*) = nullptr;
  mutable int (*value64_)(double, double, double, double*) = nullptr;
};

// Whether a constant may be called so.
bool is_formula_name(const std::string& name);

// What is said of a formula whose loops do not end.
std::string endless_formula(const std::string& title);

// Whether formulas can run on the CPU.
bool has_cpp_compiler();

}  // namespace eyeray
