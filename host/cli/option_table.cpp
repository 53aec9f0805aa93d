#include "host/cli/option_table.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "host/cli/command.hpp"
#include "host/executors/tuning.hpp"
#include "host/program/help.hpp"

namespace eyeray::engine::cli {
namespace {

// "rays=packets", "rays=lanes", …
std::vector<std::string> tuning_settings() {
  std::vector<std::string> settings;
  for (const executors::Tuning& each : executors::tunings())
    for (const std::string_view value : each.values)
      settings.push_back(fmt::format("{}={}", each.key, value));
  return settings;
}

OptionRow row_of(const CLI::Option& option) {
  OptionRow row;
  row.text = program::description_of(option);
  row.group = option.get_group();
  row.is_argument = option.get_positional();
  if (row.is_argument) {
    row.names = {option.get_name(true)};
    return row;
  }
  for (const std::string& name : option.get_snames()) row.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) row.names.push_back("--" + name);
  if (option.get_items_expected_min() == 0) return row;  // a flag
  row.value = option.get_option_text();
  if (row.value.empty()) row.value = option.get_type_name();
  row.choices = option.check_lname("tune") ? tuning_settings() : value_choices(option.get_name());
  return row;
}

CommandRow row_of(const CLI::App& app, const std::string& words) {
  CommandRow row{words, app.get_description(), app.get_footer(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) row.options.push_back(row_of(*option));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!command->get_group().empty())
      row.commands.push_back(row_of(*command, words + (words.empty() ? "" : " ") + command->get_name()));
  return row;
}

void collect(const CommandRow& row, std::vector<const CommandRow*>& all) {
  all.push_back(&row);
  for (const CommandRow& command : row.commands) collect(command, all);
}

}  // namespace

CommandRow option_table(const CLI::App& app) {
  return row_of(app, "");
}

std::vector<const CommandRow*> all_commands(const CommandRow& table) {
  std::vector<const CommandRow*> all;
  collect(table, all);
  return all;
}

std::string last_word(const CommandRow& command) {
  return command.words.substr(command.words.rfind(' ') + 1);
}

std::vector<std::string> option_groups(const CommandRow& command) {
  std::vector<std::string> groups;
  for (const OptionRow& option : command.options)
    if (std::ranges::find(groups, option.group) == groups.end()) groups.push_back(option.group);
  return groups;
}

}  // namespace eyeray::engine::cli
