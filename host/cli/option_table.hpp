// The commands and options as registered with the command line, which --help prints. Man pages,
// completions and docs/options.md are made from them.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace eyeray::engine::cli {

struct OptionRow {
  std::vector<std::string> names;    // "-o", "--output"; of an argument its own, "SCENE"
  std::string value;                 // "FILE", "SECONDS=60"; "" where it takes none
  std::vector<std::string> choices;  // the allowed values; empty: any
  std::string text;
  std::string group;
  bool is_argument = false;
};

struct CommandRow {
  std::string words;  // "generate terrain"; "" of the program itself
  std::string text;
  std::string footer;
  std::vector<OptionRow> options;  // those that --help shows
  std::vector<CommandRow> commands;
};

CommandRow option_table(const CLI::App& app);

// A command and all below it, itself first.
std::vector<const CommandRow*> all_commands(const CommandRow& table);
// "terrain" of "generate terrain".
std::string last_word(const CommandRow& command);

// The groups of its options, in the order in which --help has them.
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
