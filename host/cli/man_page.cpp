// A command's man page, made from its --help.
#include <fmt/format.h>

#include <algorithm>

#include "host/cli/option_table.hpp"

namespace eyeray::engine::cli {
namespace {

// Text as roff prints it: no command at the start of a line, no hyphen that a terminal would change.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char each : text) {
    if (each == '\\')
      escaped += "\\e";
    else if (each == '-')
      escaped += "\\-";
    else if (each == '\'')
      escaped += "\\(aq";
    else if (each == '.' && (escaped.empty() || escaped.back() == '\n'))
      escaped += "\\&.";
    else
      escaped += each;
  }
  return escaped;
}

std::string program(const CommandRow& command) {
  std::string name = "eyeray" + (command.words.empty() ? "" : "-" + command.words);
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string heading(const OptionRow& option) {
  std::string text;
  for (const std::string& name : option.names)
    text += (text.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
  if (!option.value.empty()) text += " \\fI" + roff(option.value) + "\\fR";
  return text;
}

std::string synopsis(const CommandRow& command) {
  std::string text = ".B eyeray" + (command.words.empty() ? "" : " " + roff(command.words)) + "\n";
  if (!command.commands.empty()) text += ".I COMMAND\n";
  for (const OptionRow& option : command.options)
    if (option.is_argument) text += ".RI [ " + roff(option.names[0]) + " ]\n";
  return text + ".RI [ OPTION ...]\n";
}

// The options by group. Groups appear in the order of their first option, as in --help.
std::string option_sections(const CommandRow& command) {
  std::string text = ".SH OPTIONS\n";
  for (const std::string& group : option_groups(command)) {
    if (group != "Options" && group != "Positionals") text += ".SS \"" + roff(group) + "\"\n";
    for (const OptionRow& option : command.options)
      if (option.group == group) text += ".TP\n" + heading(option) + "\n" + roff(option.text) + "\n";
  }
  return text;
}

std::string see_also(const CommandRow& command) {
  std::string text = ".SH SEE ALSO\n";
  const size_t space = command.words.rfind(' ');
  if (!command.words.empty())
    text +=
        fmt::format(".BR {} (1)\n",
                    space == std::string::npos ? "eyeray" : roff("eyeray-" + command.words.substr(0, space)));
  for (const CommandRow& each : command.commands) text += fmt::format(".BR {} (1)\n", roff(program(each)));
  return text;
}

}  // namespace

std::string man_page_name(const CommandRow& command) {
  return program(command) + ".1";
}

std::string man_page(const CommandRow& command) {
  std::string title = program(command);
  std::ranges::transform(title, title.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
  std::string text = fmt::format(".TH {} 1 \"\" \"eyeray {}\" \"eyeray\"\n", roff(title), EYERAY_VERSION);
  text += fmt::format(".SH NAME\n{} \\- {}\n", roff(program(command)),
                      roff(command.text.substr(0, command.text.find_last_not_of('.') + 1)));
  text += ".SH SYNOPSIS\n" + synopsis(command);
  if (!command.commands.empty()) {
    text += ".SH COMMANDS\n";
    for (const CommandRow& each : command.commands)
      text += fmt::format(".TP\n.BR {} (1)\n{}\n", roff(program(each)), roff(each.text));
  }
  text += option_sections(command);
  if (!command.footer.empty()) text += ".SH NOTES\n.nf\n" + roff(command.footer) + "\n.fi\n";
  return text + see_also(command);
}

}  // namespace eyeray::engine::cli
