// The variables of a scene: those of [let], and those of the loops that `repeat` makes. Private to the
// loader.
#pragma once

#include <toml++/toml.h>

#include <string_view>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/reading/number_expression.hpp"

namespace eyeray::engine::loader {

// The variables of the table [let]. A variable with an error, which is in the log, is 1.
reading::Variables read_let(const toml::table& root, DiagnosticLog& log);

// The manual of [let], and of the key `repeat`; Markdown.
std::string_view let_manual();
std::string_view repeat_manual();

// The loop of a table that is read many times.
struct Repeat {
  struct Counter {
    std::string_view name;
    size_t count;
  };
  std::vector<Counter> counters;  // the last one changes fastest
  size_t count = 1;               // product of all; 0 after an error
};

// Checks the key `repeat` of a table. Its counts may be expressions with the variables of [let].
Repeat read_repeat(const toml::table& table, reading::Variables& variables, DiagnosticLog& log);

// The copies of a table that its `repeat` makes; 1 if it is wrong.
double repeat_size(const toml::table& table, reading::Variables& variables);
// The names of a table's counters.
std::vector<std::string_view> counter_names(const toml::table& table);

// True if the contents of a group mention one of these variables: the values of its own keys do not count.
bool contents_mention(const toml::table& group, const std::vector<std::string_view>& names);

// Adds the counters' values in the copy `index` to the variables while it exists.
class LoopScope {
 public:
  LoopScope(reading::Variables& variables, const Repeat& repeat, size_t index);
  LoopScope(const LoopScope&) = delete;
  ~LoopScope() { variables_.loops.resize(outer_); }

 private:
  reading::Variables& variables_;
  size_t outer_;
};

}  // namespace eyeray::engine::loader
