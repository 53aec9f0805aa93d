// The reference of all commands and options, made from the rows that --help prints.
#include <fmt/format.h>

#include "host/cli/option_table.hpp"

namespace eyeray::engine::cli {
namespace {

// Text as a cell of a Markdown table shows it.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char each : text) {
    if (each == '|' || each == '<' || each == '*' || each == '_') escaped += '\\';
    escaped += each == '\n' ? ' ' : each;
  }
  return escaped;
}

std::string spelled(const OptionRow& option) {
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "`" : ", `") + name + "`";
  return option.value.empty() ? text : text + " " + cell(option.value);
}

// A table for each group, in the order of --help.
std::string option_tables(const CommandRow& command) {
  std::string text;
  for (const std::string& group : option_groups(command)) {
    text += fmt::format("| {} | |\n| --- | --- |\n", group == "Positionals" ? "Arguments" : cell(group));
    for (const OptionRow& option : command.options)
      if (option.group == group) text += fmt::format("| {} | {} |\n", spelled(option), cell(option.text));
    text += "\n";
  }
  return text;
}

}  // namespace

std::string option_reference(const CommandRow& table) {
  std::string text =
      "# Every command and option\n\n"
      "This page is generated from the texts that `--help` prints: `eyeray manual --markdown > "
      "docs/options.md`. "
      "[command-line.md](command-line.md) explains the commands by examples.\n\n";
  for (const CommandRow* command : all_commands(table)) {
    text += "## `eyeray" + (command->words.empty() ? "" : " " + command->words) + "`\n\n" + command->text +
            "\n\n";
    text += option_tables(*command);
    if (!command->footer.empty()) text += "```text\n" + command->footer + "\n```\n\n";
  }
  text.pop_back();
  return text;
}

}  // namespace eyeray::engine::cli
