#include "host/loader/variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "host/loader/sections.hpp"
#include "host/reading/expression_node.hpp"
#include "host/reading/source_position.hpp"

namespace eyeray::engine::loader {

namespace {

constexpr double most_copies = 0x4000000;  // as many as objects are kept (group_plan.cpp)

// Evaluates the variables in an order in which each follows those that it names.
class LetReader {
 public:
  LetReader(const toml::table& table, DiagnosticLog& log) : table_(table), log_(log) {}

  reading::Variables read() {
    for (const auto& [key, node] : table_)
      if (const std::string why = reading::why_no_name(key.str()); !why.empty())
        log_.error(reading::position_of(key.source()), why);
    for (const auto& [key, node] : table_) link(key.str(), node);
    for (const auto& [name, needs] : needed_)
      if (needs == 0) ready_.push_back(name);
    size_t done = 0;
    for (; done < ready_.size(); ++done) {
      variables_.add(std::string(ready_[done]), value(*table_.get(ready_[done])));
      for (const std::string_view user : users_[ready_[done]])
        if (--needed_[user] == 0) ready_.push_back(user);
    }
    for (const auto& [name, needs] : needed_) {
      if (needs == 0) continue;
      log_.error(reading::position_of(table_.get(name)->source()),
                 fmt::format("`{}` is needed to compute itself", name));
      variables_.add(std::string(name), {1});
    }
    return std::move(variables_);
  }

 private:
  // Counts the variables that the value names.
  void link(std::string_view name, const toml::node& node) {
    size_t& needs = needed_[name];
    const auto add = [&](const toml::node& number) {
      for (const std::string_view used : reading::names_in(reading::expression_of(number))) {
        if (!table_.contains(used)) continue;
        users_[used].push_back(name);
        ++needs;
      }
    };
    add(node);
    if (const toml::array* list = node.as_array())
      for (const toml::node& element : *list) add(element);
  }

  std::vector<double> value(const toml::node& node) {
    std::vector<double> all;
    if (const toml::array* list = node.as_array()) {
      for (const toml::node& element : *list) {
        const std::vector<double> one = numbers(element);
        all.insert(all.end(), one.begin(), one.end());
      }
      if (list->empty()) fail(node);
    } else {
      all = numbers(node);
    }
    return all.empty() ? std::vector<double>{1} : all;
  }

  std::vector<double> numbers(const toml::node& node) {
    if (node.is_number()) return {*node.value<double>()};
    if (reading::expression_of(node).empty()) return fail(node), std::vector<double>{};
    return reading::evaluate(node, variables_, log_).value_or(std::vector<double>{});
  }

  void fail(const toml::node& node) {
    log_.error(reading::position_of(node.source()),
               "a variable must be a number, a list of numbers, or an expression such as \"= 2 * width\"");
  }

  const toml::table& table_;
  DiagnosticLog& log_;
  reading::Variables variables_;
  std::map<std::string_view, size_t> needed_;  // number of mentions of variables without a value so far
  std::map<std::string_view, std::vector<std::string_view>> users_;
  std::vector<std::string_view> ready_;
};

bool mention(const toml::node& node, const std::vector<std::string_view>& names) {
  if (const toml::table* table = node.as_table())
    return std::ranges::any_of(*table, [&](const auto& entry) { return mention(entry.second, names); });
  if (const toml::array* list = node.as_array())
    return std::ranges::any_of(*list, [&](const toml::node& element) { return mention(element, names); });
  return std::ranges::any_of(reading::names_in(reading::expression_of(node)), [&](std::string_view name) {
    return std::ranges::find(names, name) != names.end();
  });
}

}  // namespace

std::string_view let_manual() {
  static const std::string text = fmt::format(
      R"md(Where a table takes a number, `"= EXPRESSION"` may stand.

```toml
[let]
height = 0.8
legs = 4
seat = ["= 0.3 * height", 0.05, 0.25]

[[cylinder]]
repeat = {{ i = "= legs" }}
from = ["= 0.3 * cos(2 * pi * i / legs)", 0, "= 0.3 * sin(2 * pi * i / legs)"]
to = ["= 0.2 * cos(2 * pi * i / legs)", "= height", "= 0.2 * sin(2 * pi * i / legs)"]
radius = "= seat[1] / 2"
material = "wall"
```

A variable is a number or a list of numbers. `seat[1]` is a list's second number. `"= seat"` is the whole list,
for a key that takes one. Variables may stand in any order. `-D let.height=1` sets one from the command line, and a
[[track]] with the target `let.height` animates it.

Expressions have the operators of C: `+ - * / %`, comparisons, `&& || !` and `a ? b : c`. True is 1, and false is 0.
The result of `%` has the sign of the divisor. Angles are in radians. `random` returns a number from 0 to below 1
that its arguments determine. The functions and constants are {}.

Keyframes of a [[track]] are plain numbers.)md",
      reading::functions_text());
  return text;
}

std::string_view repeat_manual() {
  return R"md(Many shapes, lights, or instances of a mesh or a group, from one table. `repeat` names counters. The table is read
once for each combination of their values, which begin at 0. The counter that is last in the alphabet changes fastest.
Expressions in the table use the counters.

```toml
[[sphere]]
repeat = { i = 8, j = 5 }
center = ["= i - 3.5", "= 0.3 + 0.1 * sin(i * j)", "= j"]
radius = 0.3
material = "glass"
```

The tables in a [[group]] use the group's counters, too. The counters of an [[instance]] do not reach into its group.
A count may use the variables of [[let]](#let).)md";
}

reading::Variables read_let(const toml::table& root, DiagnosticLog& log) {
  const toml::node* node = root.get("let");
  return node && node->is_table() ? LetReader(*node->as_table(), log).read() : reading::Variables();
}

Repeat read_repeat(const toml::table& table, reading::Variables& variables, DiagnosticLog& log) {
  const toml::node* node = table.get(repeat_key);
  if (!node) return {};
  const auto fail = [&](const toml::source_region& at, std::string message) {
    log.error(reading::position_of(at), std::move(message));
    return Repeat{{}, 0};
  };
  const toml::table* counters = node->as_table();
  if (!counters || counters->empty())
    return fail(node->source(), "`repeat` must be a table of counters, such as { i = 8 }");
  if (table.contains(batch_key)) return fail(node->source(), "a table has a `batch` or a `repeat`, not both");
  Repeat repeat;
  double product = 1;
  for (const auto& [key, value] : *counters) {
    if (const std::string why = reading::why_no_name(key.str()); !why.empty()) return fail(key.source(), why);
    double count = value.is_number() ? *value.value<double>() : 0;
    if (!reading::expression_of(value).empty()) {
      const auto around = std::exchange(variables.loops, {});
      const auto numbers = reading::evaluate(value, variables, log);
      variables.loops = around;
      if (!numbers) return {{}, 0};
      count = numbers->size() == 1 ? (*numbers)[0] : 0;
    }
    if (!(count >= 1 && count <= most_copies && count == std::floor(count)))
      return fail(value.source(),
                  fmt::format("`{}` must be an integer from 1 to {:.0f}", key.str(), most_copies));
    product *= count;
    if (product > most_copies)
      return fail(node->source(), fmt::format("`repeat` makes more than {:.0f} copies", most_copies));
    repeat.counters.push_back({key.str(), size_t(count)});
    repeat.count *= size_t(count);
  }
  return repeat;
}

double repeat_size(const toml::table& table, reading::Variables& variables) {
  if (!table.contains(repeat_key)) return 1;
  DiagnosticLog unheard;
  return std::max(1.0, double(read_repeat(table, variables, unheard).count));
}

std::vector<std::string_view> counter_names(const toml::table& table) {
  std::vector<std::string_view> names;
  if (const toml::table* counters = table[repeat_key].as_table())
    for (const auto& [key, value] : *counters) names.push_back(key.str());
  return names;
}

bool contents_mention(const toml::table& group, const std::vector<std::string_view>& names) {
  return !names.empty() && std::ranges::any_of(placed_names(), [&](std::string_view name) {
    const toml::node* list = group.get(name);
    return list && mention(*list, names);
  });
}

LoopScope::LoopScope(reading::Variables& variables, const Repeat& repeat, size_t index)
    : variables_(variables), outer_(variables.loops.size()) {
  size_t rest = repeat.count;
  for (const Repeat::Counter& counter : repeat.counters) {
    rest /= counter.count;
    variables.loops.push_back({counter.name, {double(index / rest % counter.count)}});
  }
}

}  // namespace eyeray::engine::loader
