// Completions for shells. If eyeray has nothing to offer, shells complete the names of files.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/cli/option_table.hpp"
#include "host/core/escaped_text.hpp"

namespace eyeray::engine::cli {
namespace {

// The first sentence of a description, for lists of completions.
std::string brief(const std::string& text) {
  const size_t end = text.find_first_of(".:;(");
  return text.substr(0, text.find_last_not_of(' ', end == std::string::npos ? end : end - 1) + 1);
}

std::vector<std::string> names_of(const std::vector<CommandRow>& commands) {
  std::vector<std::string> names;
  for (const CommandRow& each : commands) names.push_back(last_word(each));
  return names;
}

// "'render -o'|'render --output'": the options after their command, as patterns of bash's `case`.
std::string pattern(const CommandRow& command, const OptionRow& option) {
  std::vector<std::string> cases;
  for (const std::string& name : option.names) cases.push_back(shell_word(command.words + " " + name));
  return fmt::format("{}", fmt::join(cases, "|"));
}

std::string bash_command(const CommandRow& command) {
  std::vector<std::string> words = names_of(command.commands);
  for (const OptionRow& option : command.options)
    if (!option.is_argument) words.insert(words.end(), option.names.begin(), option.names.end());
  return fmt::format("    {}) words={} ;;\n", shell_word(command.words),
                     shell_word(fmt::format("{}", fmt::join(words, " "))));
}

std::string bash_values(const CommandRow& command) {
  std::string text;
  for (const OptionRow& option : command.options) {
    if (option.value.empty()) continue;
    text += fmt::format("    {}) words={} value=1 ;;\n", pattern(command, option),
                        shell_word(fmt::format("{}", fmt::join(option.choices, " "))));
  }
  return text;
}

std::string zsh_text(const std::string& text) {
  std::string escaped;
  for (const char each : brief(text)) {
    if (each == '[' || each == ']' || each == ':' || each == '\\') escaped += '\\';
    escaped += each;
  }
  return escaped;
}

// The name of a command's function: _eyeray_generate_terrain.
std::string zsh_function(const CommandRow& command) {
  std::string name = "_eyeray" + (command.words.empty() ? "" : "_" + command.words);
  std::ranges::replace(name, ' ', '_');
  return name;
}

std::string zsh_options(const CommandRow& command) {
  std::string text;
  for (const OptionRow& option : command.options) {
    if (option.is_argument) continue;
    std::string rest = fmt::format("[{}]", zsh_text(option.text));
    if (!option.choices.empty())
      rest += fmt::format(":value:({})", fmt::join(option.choices, " "));
    else if (!option.value.empty())
      rest += ":value:_files";
    for (const std::string& name : option.names) text += " \\\n    " + shell_word("*" + name + rest);
  }
  return text;
}

std::string zsh_command(const CommandRow& command) {
  std::string text = zsh_function(command) + "() {\n";
  if (command.commands.empty())
    return text + "  _arguments" + zsh_options(command) + " \\\n    '*:file:_files'\n}\n\n";
  text += "  local curcontext=$curcontext state line\n  _arguments -C" + zsh_options(command) +
          " \\\n    '1:command:->command' '*::rest:->rest'\n  case $state in\n    command)\n      local -a "
          "commands=(";
  for (const CommandRow& each : command.commands)
    text += "\n        " + shell_word(last_word(each) + ":" + zsh_text(each.text));
  text += ")\n      _describe command commands ;;\n    rest)\n      case $words[1] in\n";
  for (const CommandRow& each : command.commands)
    text += fmt::format("        {}) {} ;;\n", last_word(each), zsh_function(each));
  return text + "      esac ;;\n  esac\n}\n\n";
}

// The condition under which fish offers a command's options and subcommands.
std::string fish_condition(const CommandRow& command) {
  if (command.words.empty()) return "__fish_use_subcommand";
  std::string condition, word;
  for (const char each : command.words + " ") {
    if (each != ' ') {
      word += each;
      continue;
    }
    condition += (condition.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + word);
    word.clear();
  }
  return condition;
}

}  // namespace

std::string bash_completion(const CommandRow& table) {
  std::vector<std::string> commands;
  std::string words, values;
  for (const CommandRow* each : all_commands(table)) {
    if (!each->words.empty()) commands.push_back(shell_word(each->words));
    words += bash_command(*each);
    values += bash_values(*each);
  }
  return "# Made by eyeray completion bash.\n_eyeray() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command='' words='' "
         "value='' key='' i\n"
         "  # KEY=VALUE is three words to bash.\n"
         "  if [ \"$word\" = = ] || [ \"$before\" = = ]; then\n"
         "    [ \"$word\" = = ] && i=1 word='' || i=2\n"
         "    key=${COMP_WORDS[COMP_CWORD-i]}= before=${COMP_WORDS[COMP_CWORD-i-1]}\n"
         "  fi\n"
         "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
         "    case \"${command:+$command }${COMP_WORDS[i]}\" in\n"
         "      " +
         fmt::format("{}", fmt::join(commands, "|")) +
         ")\n        command=\"${command:+$command }${COMP_WORDS[i]}\" ;;\n    esac\n  done\n"
         "  case \"$command\" in\n" +
         words + "  esac\n  case \"$command $before\" in\n" + values +
         "  esac\n"
         "  # Options when a word begins like one; the values that an option lists; else commands, or "
         "files.\n"
         "  if [ -z \"$value\" ] && [ \"${word#-}\" = \"$word\" ]; then\n"
         "    local all=$words each; words=''\n"
         "    for each in $all; do [ \"${each#-}\" = \"$each\" ] && words=\"$words $each\"; done\n"
         "  fi\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$key$word\")\n"
         "  COMPREPLY=(\"${COMPREPLY[@]#\"$key\"}\")\n"
         "}\ncomplete -o default -F _eyeray eyeray\n";
}

std::string zsh_completion(const CommandRow& table) {
  std::string text = "#compdef eyeray\n# Made by eyeray completion zsh.\n\n";
  for (const CommandRow* each : all_commands(table)) text += zsh_command(*each);
  return text + "_eyeray \"$@\"\n";
}

std::string fish_completion(const CommandRow& table) {
  std::string text = "# Made by eyeray completion fish.\n";
  for (const CommandRow* command : all_commands(table)) {
    std::string condition = fish_condition(*command);
    for (const OptionRow& option : command->options) {
      if (option.is_argument) continue;
      text += "complete -c eyeray -n " + shell_word(condition);
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.choices.empty())
        text += " -x -a " + shell_word(fmt::format("{}", fmt::join(option.choices, " ")));
      else if (!option.value.empty())
        text += " -r";
      text += " -d " + shell_word(brief(option.text)) + "\n";
    }
    // Offer a command's second words only until one of them has been typed.
    const std::vector<std::string> names = names_of(command->commands);
    if (!command->words.empty() && !names.empty())
      condition += fmt::format("; and not __fish_seen_subcommand_from {}", fmt::join(names, " "));
    for (const CommandRow& each : command->commands)
      text += fmt::format("complete -c eyeray -n {} -f -a {} -d {}\n", shell_word(condition), last_word(each),
                          shell_word(brief(each.text)));
  }
  return text;
}

}  // namespace eyeray::engine::cli
