#include "host/reading/formula_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/core/error.hpp"

namespace eyeray::engine::reading {

bool has_one_source(TableReader& table, std::initializer_list<std::string_view> sources,
                    std::string_view owner) {
  const auto given = std::ranges::count_if(sources, [&](auto key) { return table.has(key); });
  if (given == 1) return true;
  std::vector<std::string> names;
  for (const std::string_view key : sources) names.push_back(fmt::format("`{}`", key));
  const std::string last = names.back();
  names.pop_back();
  for (const std::string_view key : sources)
    if (given == 0 || table.has(key)) {
      table.error(key, given == 0 ? fmt::format("{} needs a function: give {} or {}", owner,
                                                fmt::join(names, ", "), last)
                                  : fmt::format("{} takes only one function: give either {} or {}", owner,
                                                fmt::join(names, ", "), last));
      return false;
    }
  return false;
}

std::string formula_title(const TableReader& table, std::string_view owner) {
  const SourcePosition at = table.position();
  return fmt::format("the function of {} at {}:{}", owner, at.file, at.line);
}

std::vector<formula::FormulaParameter> formula_parameters(const TableReader& table) {
  return table.has("parameters") ? table.parameters("parameters") : std::vector<formula::FormulaParameter>();
}

std::shared_ptr<const formula::Formula> read_formula(TableReader& table, std::string_view owner,
                                                     formula::FormulaKind kind) {
  try {
    return std::make_shared<const formula::Formula>(table.formula(table.has("code") ? "code" : "file"),
                                                    formula_parameters(table), formula_title(table, owner),
                                                    kind);
  } catch (const InputError& faults) {
    table.error(faults);
    return nullptr;
  }
}

}  // namespace eyeray::engine::reading
