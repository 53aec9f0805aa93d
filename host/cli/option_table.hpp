// The commands and options that are registered with the command line, and that --help prints. Man pages,
// completions and docs/options.md are made from them.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace eyeray::engine::cli {

struct OptionRow {
  std::vector<std::string> names;    // "-o", "--output"; of an argument its name, "SCENE"
  std::string value;                 // "FILE", "SECONDS=60"; "" if the option takes no value
  std::vector<std::string> choices;  // the allowed values; empty: any
  std::string text;
  std::string group;
  bool is_argument = false;
};

struct CommandRow {
  std::string words;  // "generate terrain"; "" for the program itself
  std::string text;
  std::string footer;
  std::vector<OptionRow> options;  // those that --help shows
  std::vector<CommandRow> commands;
};

CommandRow option_table(const CLI::App& app);

// A command, followed by all commands below it.
std::vector<const CommandRow*> all_commands(const CommandRow& table);
// The last word of a command: "terrain" for "generate terrain".
std::string last_word(const CommandRow& command);

// The groups of a command's options, in the order of --help.
std::vector<std::string> option_groups(const CommandRow& command);

// "eyeray-generate-terrain.1", in roff's man macros.
std::string man_page_name(const CommandRow& command);
std::string man_page(const CommandRow& command);
// docs/options.md: all commands and options, as Markdown.
std::string option_reference(const CommandRow& table);

// Scripts that complete commands, options and the values that options list.
std::string bash_completion(const CommandRow& table);
std::string zsh_completion(const CommandRow& table);
std::string fish_completion(const CommandRow& table);

}  // namespace eyeray::engine::cli
