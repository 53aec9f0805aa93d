// Arithmetic in a scene's numbers: the text of a value such as "= 2 * width".
#pragma once

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace eyeray::engine::reading {

// The variables that expressions may name. Each is a number, or a list of numbers.
class Variables {
 public:
  struct Loop {
    std::string_view name;
    std::vector<double> value;
  };

  // Adds a variable of the whole scene.
  void add(std::string name, std::vector<double> value) { lets_[std::move(name)] = std::move(value); }
  // The value of the variable, or null. A loop's variable hides others of its name, also those of loops
  // around it.
  const std::vector<double>* find(std::string_view name) const;
  std::vector<std::string_view> names() const;

  // The counters of the loops around the table that is read, the outermost first.
  std::vector<Loop> loops;

 private:
  std::map<std::string, std::vector<double>, std::less<>> lets_;
};

// A fault in an expression, at a byte of its text.
struct ExpressionFault : std::runtime_error {
  ExpressionFault(const std::string& message, size_t at) : std::runtime_error(message), offset(at) {}
  size_t offset;
};

// True if the text is an expression: it begins with "=".
inline bool is_expression(std::string_view text) {
  return text.starts_with('=');
}

// The value of an expression: one number, which may be infinite or NaN, or the list that it names.
// ExpressionFault if it is wrong.
std::vector<double> evaluate(std::string_view expression, const Variables& variables);

// The reason why a variable cannot have that name, or "".
std::string why_no_name(std::string_view name);

// All names in an expression: those of variables, functions and constants.
std::vector<std::string_view> names_in(std::string_view expression);

// All functions, with their arguments, and constants, for the manual: "`abs(x)`, … and `pi`".
std::string functions_text();

}  // namespace eyeray::engine::reading
