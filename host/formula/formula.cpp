#include "host/formula/formula.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <span>

#include "host/core/error.hpp"
#include "host/core/termination.hpp"
#include "host/formula/execution.hpp"
#include "host/formula/folding.hpp"
#include "host/formula/kernel_text.hpp"
#include "host/formula/limits.hpp"
#include "host/formula/lowering.hpp"
#include "host/formula/machine.hpp"
#include "host/formula/text.hpp"
#include "host/formula/vocabulary.hpp"
#include "host/gpu/compiler_messages.hpp"
#include "host/gpu/shader_compiler.hpp"

namespace eyeray::engine::formula {

struct Compiled {
  FormulaKind kind;
  Text text;
  Module module;
  ir::Program program;
  Machine value;
  std::optional<Machine> other;
};

namespace {

// Limit on the steps of straight-line code. Each step is a call in kernels, and drivers take more than a
// second for a hundred of them.
constexpr size_t most_straight_steps = 512;

// The function's name, mangled as glslang mangles it.
std::string mangled(const Entry& entry) {
  return fmt::format("{}{}(vf{};", user_prefix, entry.name, entry.parameter.back());
}

// A statement that calls the function, so that a compiler keeps the function.
std::string call(const Entry& entry, int number) {
  return fmt::format("values[{}].{} = {}{}(values[0].{});", number, entry.type == "float" ? "x" : "xyz",
                     user_prefix, entry.name,
                     std::string_view("xyzw").substr(0, size_t(entry.parameter.back() - '0')));
}

// A camera's functions of one vec4, as executors call them. They call the text's functions of two vec2.
std::string as_called(FormulaKind kind, bool has_other) {
  if (kind != FormulaKind::camera) return "";
  const auto of_both = [](const Entry& entry) {
    return fmt::format("{0} {1}{2}({3} at) {{ return {1}{2}(at.xy, at.zw); }}\n", entry.type, user_prefix,
                       entry.name, entry.parameter);
  };
  return of_both(entry_of(kind)) + (has_other ? of_both(other_entry_of(kind)) : "");
}

// A line "QUALIFIER TYPE NAME = TYPE(…);" for each parameter.
std::string constants(const std::vector<FormulaParameter>& parameters, std::string_view qualifier) {
  std::string text;
  for (const FormulaParameter& parameter : parameters) {
    std::vector<std::string> values;
    for (const double value : parameter.values) values.push_back(fmt::format("{:.9e}", double(float(value))));
    const std::string type =
        parameter.values.size() == 1 ? "float" : fmt::format("vec{}", parameter.values.size());
    text += fmt::format("{4} {0} {1}{2} = {0}({3});\n", type, user_prefix, parameter.name,
                        fmt::join(values, ", "), qualifier);
  }
  return text;
}

constexpr const char* main_file = "formula.comp";
constexpr const char* text_file = "text";

// The SPIR-V that glslang makes from a text and the declarations before it.
std::vector<uint32_t> spirv_of(FormulaKind kind, bool has_other, const std::string& before,
                               const std::string& text) {
  gpu::ShaderSource source{main_file, {}};
  source.files[text_file] = text;
  source.files[main_file] = fmt::format(
      "#version 450\nlayout(local_size_x = 1) in;\nlayout(std430, set = 0, binding = 0) buffer Values {{ "
      "vec4 values[]; }};\n{}"
      "#line 1 \"{}\"\n{}\n#line 1 \"{}\"\n{}void main() {{ {} {} }}\n",
      before, text_file, text, main_file, as_called(kind, has_other), call(entry_of(kind), 1),
      has_other ? call(other_entry_of(kind), 2) : "");
  return gpu::compile_shader(source, "", gpu::Lines::kept).spirv;
}

// Throws InputError for the faults that glslang finds in Text::glsl(). The module is compiled from
// Text::unfolded(), because glslang would fold constants, in float64 and by its own rules.
Module module_of(FormulaKind kind, const Text& text, const std::vector<FormulaParameter>& parameters) {
  (void)spirv_of(kind, text.has_other, constants(parameters, "const"), text.glsl());
  std::string before = constants(parameters, "");
  const std::string unfolded = text.unfolded(before);
  Module module(of_own_input([&] { return spirv_of(kind, text.has_other, before, unfolded); }));
  fold(module);
  return module;
}

// The diagnostic of a fault in the text, at its position in the file that contains the text.
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

// A compiler's message, with names as the user wrote them.
std::string without_prefix(std::string_view message) {
  std::string result;
  while (!message.empty()) {
    const bool begins = result.empty() || result.back() == '\'' || result.back() == ' ';
    if (begins && message.starts_with(user_prefix)) message.remove_prefix(user_prefix.size());
    result += message[0];
    message.remove_prefix(1);
  }
  return result;
}

// Compiles a text once for equal parameters, for as long as the result is in use.
std::shared_ptr<const Compiled> compiled(FormulaKind kind, const Text& text,
                                         const std::vector<FormulaParameter>& parameters,
                                         std::vector<Fault>& faults) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const Compiled>> known;
  const std::string entry = mangled(entry_of(kind)), key = entry + constants(parameters, "") + text.glsl();
  const std::scoped_lock lock(mutex);
  std::erase_if(known, [](const auto& known_text) { return known_text.second.expired(); });
  // The last owner of an entry may release it even now.
  if (const auto found = known.find(key); found != known.end())
    if (auto still_there = found->second.lock()) return still_there;

  Module module = module_of(kind, text, parameters);
  ir::Program program = lower(module, entry, text.has_other ? mangled(other_entry_of(kind)) : "");
  if (std::string why = limit(program); !why.empty()) {
    faults.push_back({1, 1, std::move(why)});
    return nullptr;
  }
  Machine value(program, program.value);
  std::optional<Machine> other;
  if (!program.other.empty()) other.emplace(program, program.other[0]);
  const std::shared_ptr<const Compiled> result(
      new Compiled{kind, text, std::move(module), std::move(program), std::move(value), std::move(other)});
  known[key] = result;
  return result;
}

}  // namespace

Formula::Formula(FormulaText text, std::vector<FormulaParameter> parameters, std::string title,
                 FormulaKind kind)
    : text_(std::move(text)), parameters_(std::move(parameters)), title_(std::move(title)), kind_(kind) {
  std::vector<Fault> faults;
  Text judged = read_text(text_.text, kind, faults);
  for (const FormulaParameter& parameter : parameters_) {
    if (parameter.name == entry_of(kind).name)
      faults.push_back(
          {1, 1, fmt::format("no parameter can be named `{}`: that is the function's name", parameter.name)});
    for (const double value : parameter.values)
      if (!std::isfinite(float(value)))
        faults.push_back(
            {1, 1, fmt::format("the parameter `{}` = {:g} is beyond float32", parameter.name, value)});
  }
  if (faults.empty()) {
    try {
      compiled_ = compiled(kind, judged, parameters_, faults);
    } catch (const InputError& error) {
      throw InputError(in_text(error, judged));
    }
  }
  if (faults.empty()) {
    if (!judged.uncalled_other) return;
    const Token& name = judged.tokens[*judged.uncalled_other];
    uncalled_other_ = located(text_, name.line, name.column, "").position;
    return;
  }
  std::vector<Diagnostic> diagnostics;
  for (const Fault& fault : std::span(faults).first(std::min(faults.size(), gpu::most_messages)))
    diagnostics.push_back(located(text_, fault.line, fault.column, fault.message));
  if (faults.size() > gpu::most_messages)
    diagnostics.back().message += gpu::more_errors(faults.size() - gpu::most_messages);
  throw InputError(std::move(diagnostics));
}

Formula::~Formula() = default;

// Converts a compiler's errors in Text::glsl() to errors in the user's text.
std::vector<Diagnostic> Formula::in_text(const InputError& error, const Text& text) const {
  std::vector<Diagnostic> diagnostics;
  const std::vector<Text::Position> positions = text.positions();
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    // Finds the last token on the line that begins at or before the column of the error.
    const auto [line, column] = std::pair(std::max(diagnostic.position.line, 1), diagnostic.position.column);
    int source_column = 0;
    for (const Text::Position& position : positions)
      if (position.line == line && position.column <= column) source_column = position.source_column;
    diagnostics.push_back(located(text_, line, source_column, without_prefix(diagnostic.message)));
    diagnostics.back().severity = diagnostic.severity;
  }
  return diagnostics;
}

bool Formula::same(const Formula& other) const {
  return kind_ == other.kind_ && text_.text == other.text_.text && parameters_ == other.parameters_;
}

bool Formula::has_other() const {
  return compiled_->other.has_value();
}

double Formula::instructions() const {
  return size_of(compiled_->program).instructions;
}

std::string Formula::kernel(const std::string& name, expression::LoadedNumbers* numbers) const {
  return kernel_text(compiled_->program, compiled_->kind, name, numbers);
}

bool Formula::loops() const {
  return compiled_->program.counts_iterations;
}

const expression::StraightLine& Formula::straight_line() const {
  std::call_once(straightened_, [&] {
    try {
      expression::Expression expression;
      Execution execution(compiled_->module, expression);
      straight_line_ =
          expression::straight_line(expression, execution.run(mangled(entry_of(compiled_->kind))));
      if (straight_line_.size() > most_straight_steps)
        throw InputError({{Severity::error,
                           {},
                           fmt::format("with loops, calls and branches expanded, the function has {} "
                                       "operations; at most {} are allowed",
                                       straight_line_.size(), most_straight_steps),
                           ""}});
    } catch (const InputError& error) {
      std::vector<Diagnostic> diagnostics = in_text(error, compiled_->text);
      for (Diagnostic& diagnostic : diagnostics)
        diagnostic.message += "; so no interval can be computed for it: declare a `lipschitz`";
      throw InputError(std::move(diagnostics));
    }
  });
  return straight_line_;
}

template <size_t Results, typename T, size_t Inputs>
std::array<T, Results> Formula::run(const std::array<T, Inputs>& input, uint64_t* iterations) const {
  std::array<T, Results> results{};
  stop_if_interrupted();
  if (!compiled_->value.run(input, results.data(), iterations)) endless();
  return results;
}

template <typename T, size_t Inputs>
std::array<T, 3> Formula::run_other(const std::array<T, Inputs>& input) const {
  std::array<T, 3> results{};
  if (!compiled_->other->run(input, results.data())) endless();
  return results;
}

float Formula::value(const std::array<float, 3>& p) const {
  return run<1>(p)[0];
}

double Formula::value(const std::array<double, 3>& p, uint64_t* iterations) const {
  return run<1>(p, iterations)[0];
}

std::array<float, 3> Formula::color(const std::array<float, 2>& uv) const {
  return run<3>(uv);
}

std::array<double, 3> Formula::color(const std::array<double, 2>& uv) const {
  return run<3>(uv);
}

std::array<float, 3> Formula::gradient(const std::array<float, 3>& p) const {
  return run_other(p);
}

std::array<float, 3> Formula::direction(const std::array<float, 4>& at) const {
  return run<3>(at);
}

std::array<double, 3> Formula::direction(const std::array<double, 4>& at) const {
  return run<3>(at);
}

std::array<float, 3> Formula::origin(const std::array<float, 4>& at) const {
  return has_other() ? run_other(at) : std::array<float, 3>{};
}

std::array<double, 3> Formula::origin(const std::array<double, 4>& at) const {
  return has_other() ? run_other(at) : std::array<double, 3>{};
}

void Formula::endless() const {
  throw Error(ExitCode::timed_out, endless_formula(title_));
}

bool is_formula_name(const std::string& name) {
  const auto is_part = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && !(name[0] >= '0' && name[0] <= '9') && std::ranges::all_of(name, is_part) &&
         !name.starts_with("gl_") && !is_type(name) && !is_keyword(name) && !is_refused(name);
}

std::string endless_formula(const std::string& title) {
  return fmt::format(
      "{} did not end: its loops made more than 10000 iterations in one call, the most that eyeray allows",
      title);
}

}  // namespace eyeray::engine::formula
