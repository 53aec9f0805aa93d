// Reads users' formulas from the keys of a scene's tables.
#pragma once

#include <initializer_list>
#include <memory>
#include <vector>

#include "host/formula/formula.hpp"
#include "host/reading/table_reader.hpp"

namespace eyeray::engine::reading {

// Keys by which a table gives the text of a formula, and its constants. A third key, `code`, is not here:
// each table declares it with a doc of its own.
inline constexpr Key formula_file_key{
    .name = "file",
    .type = KeyType::formula_file,
    .doc = "Name of a file with the function, relative to the scene file that contains this key.",
    .optional = true};
inline constexpr Key parameters_key{.name = "parameters",
                                    .type = KeyType::parameters,
                                    .doc = "Constants that the function may use.",
                                    .optional = true};

// True if exactly one of the keys `sources` stands in the table; else an error is reported. `owner` names the
// table in messages: "[[implicit]]".
bool has_one_source(TableReader& table, std::initializer_list<std::string_view> sources,
                    std::string_view owner);

// The title of the table's formula, for messages: "the function of [[implicit]] at scene.toml:12".
std::string formula_title(const TableReader& table, std::string_view owner);

// The value of the key `parameters`; empty if it is absent.
std::vector<formula::FormulaParameter> formula_parameters(const TableReader& table);

// The formula in the table's `code` or `file`, with its `parameters`; null after an error.
std::shared_ptr<const formula::Formula> read_formula(TableReader& table, std::string_view owner,
                                                     formula::FormulaKind kind);

}  // namespace eyeray::engine::reading
