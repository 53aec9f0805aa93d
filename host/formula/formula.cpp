#include "formula/formula.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "formula/cpp_language.hpp"
#include "formula/cpp_library.hpp"
#include "formula/translation.hpp"
#include "formula/vocabulary.hpp"

namespace eyeray {

namespace {

using formula::Fault;
using formula::Program;

constexpr size_t longest_text = size_t{1} << 16;
// Of names in what a GLSL compiler is shown; taken out of its messages.
const std::string check_prefix = "user_";
const std::string cpp_prefix = "u_";

std::string type_of(const FormulaParameter& parameter) {
  return parameter.values.size() == 1 ? "float" : fmt::format("vec{}", parameter.values.size());
}

// "TYPE NAME = TYPE(…);" a line each.
template <typename Literal>
std::string constants(const std::vector<FormulaParameter>& parameters, const std::string& prefix,
                      std::string_view qualifier, std::string_view scalar, const Literal& literal) {
  std::string text;
  for (const FormulaParameter& parameter : parameters) {
    std::vector<std::string> values;
    for (const double value : parameter.values) values.push_back(literal(value));
    const std::string type = parameter.values.size() == 1 ? std::string(scalar) : type_of(parameter);
    text += fmt::format("{}{} {}{} = {}({});\n", qualifier, type, prefix, parameter.name, type,
                        fmt::join(values, ", "));
  }
  return text;
}

std::string decimal(double value) {
  return fmt::format("{:.17e}", value);
}

// Line `number` (from 1) of a text.
std::string line_of(std::string_view text, int number) {
  for (int line = 1; line < number; ++line) {
    const size_t end = text.find('\n');
    if (end == std::string_view::npos) return "";
    text.remove_prefix(end + 1);
  }
  return std::string(text.substr(0, text.find_first_of("\r\n")));
}

// A place in the text as one in the file that it stands in.
Diagnostic located(const FormulaText& text, int line, int column, std::string message) {
  Diagnostic diagnostic;
  diagnostic.message = std::move(message);
  diagnostic.position = text.start;
  const int indent = text.start.line > 0 && line == 1 ? text.start.column - 1 : 0;
  if (text.start.line > 0) {
    diagnostic.position.line = text.start.line + line - 1;
    diagnostic.position.column = column > 0 ? column + indent : 0;
  }
  show_source_line(diagnostic, line_of(text.text, line), 1 + indent);
  return diagnostic;
}

}  // namespace

Formula::Formula(FormulaText text, std::vector<FormulaParameter> parameters, std::string title)
    : text_(std::move(text)), parameters_(std::move(parameters)), title_(std::move(title)) {
  std::vector<Fault> faults;
  if (text_.text.size() > longest_text)
    faults.push_back({1, 1, fmt::format("a formula has at most {} bytes", longest_text)});
  std::vector<std::string> names;
  for (const FormulaParameter& parameter : parameters_) names.push_back(parameter.name);
  if (faults.empty()) program_ = std::make_unique<const Program>(formula::analyse(text_.text, names, faults));
  if (faults.empty()) return;
  std::vector<Diagnostic> diagnostics;
  for (const Fault& fault : faults)
    diagnostics.push_back(located(text_, fault.line, fault.column, fault.message));
  throw InputError(std::move(diagnostics));
}

Formula::~Formula() = default;

bool Formula::same(const Formula& other) const {
  return text_.text == other.text_.text && parameters_ == other.parameters_;
}

std::string Formula::declarations() const {
  return constants(parameters_, "", "const ", "float", decimal);
}

Formula::Checkable Formula::checkable() const {
  return {constants(parameters_, check_prefix, "const ", "float", decimal),
          formula::checked_glsl(*program_, check_prefix).text};
}

Diagnostic Formula::in_user_text(Diagnostic diagnostic) const {
  // The names as they were written.
  std::string message;
  for (std::string_view rest = diagnostic.message; !rest.empty();) {
    size_t skip = 0;
    const bool begins = message.empty() || message.back() == '\'' || message.back() == ' ';
    for (const std::string_view prefix : {std::string_view(check_prefix), std::string_view("fn_")})
      if (begins && rest.starts_with(prefix)) skip = prefix.size();
    if (skip == 0) message += rest[0];
    rest.remove_prefix(std::max<size_t>(skip, 1));
  }

  // The last token that begins no farther right.
  const auto [line, column] = std::pair(diagnostic.position.line, diagnostic.position.column);
  int source_column = 0;
  for (const formula::Place& place : formula::checked_glsl(*program_, check_prefix).places)
    if (place.line == line && place.column <= column) source_column = place.source_column;
  Diagnostic there = located(text_, std::max(line, 1), source_column, std::move(message));
  there.severity = diagnostic.severity;
  return there;
}

std::string Formula::kernel(const std::string& name) const {
  const auto literal = [](double value) { return formula::unfolded(float(value)); };
  return constants(parameters_, name, "", "float", literal) + formula::kernel_glsl(*program_, name).text;
}

bool Formula::loops() const {
  return !program_->conditions.empty();
}

bool Formula::has_gradient() const {
  return std::ranges::any_of(program_->functions, [](const Program::Function& function) {
    return function.name == "gradient" && function.type == "vec3" && function.body.begin < function.body.end;
  });
}

void Formula::compile() const {
  std::call_once(compiled_, [&] {
    const auto single = [](double value) { return fmt::format("real({})", decimal(double(float(value)))); };
    const auto full = [](double value) { return fmt::format("real({})", decimal(value)); };
    const std::string unit = formula::cpp_unit(constants(parameters_, cpp_prefix, "const ", "real", single),
                                               constants(parameters_, cpp_prefix, "const ", "real", full),
                                               formula::cpp(*program_, cpp_prefix).text, has_gradient());
    library_ = formula::CppLibrary::load(unit, title_, DiskCache::of_user());
    value32_ = reinterpret_cast<decltype(value32_)>(library_->symbol("eyeray_f32"));
    if (has_gradient())
      gradient32_ = reinterpret_cast<decltype(gradient32_)>(library_->symbol("eyeray_gradient_f32"));
    value64_ = reinterpret_cast<decltype(value64_)>(library_->symbol("eyeray_f64"));
  });
}

float Formula::value(const std::array<float, 3>& p) const {
  compile();
  float value = 0;
  if (value32_(p[0], p[1], p[2], &value) != 0) endless();
  return value;
}

double Formula::value(const std::array<double, 3>& p) const {
  compile();
  double value = 0;
  if (value64_(p[0], p[1], p[2], &value) != 0) endless();
  return value;
}

std::array<float, 3> Formula::gradient(const std::array<float, 3>& p) const {
  compile();
  std::array<float, 3> gradient{};
  if (gradient32_(p[0], p[1], p[2], gradient.data()) != 0) endless();
  return gradient;
}

void Formula::endless() const {
  throw Error(ExitCode::timed_out, endless_formula(title_));
}

bool is_formula_name(const std::string& name) {
  const auto is_part = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && !(name[0] >= '0' && name[0] <= '9') && std::ranges::all_of(name, is_part) &&
         name != "f" && !name.starts_with("gl_") && !formula::is_type(name) && !formula::is_keyword(name) &&
         !formula::is_refused(name);
}

std::string endless_formula(const std::string& title) {
  return fmt::format(
      "{} did not come to an end: in one call its loops made more than 10000 turns, which is as long as "
      "eyeray waits",
      title);
}

bool has_cpp_compiler() {
  return formula::has_cpp_compiler();
}

}  // namespace eyeray
