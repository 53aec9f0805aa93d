#include "host/program/help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "host/build/build_facts.hpp"

namespace eyeray::engine::program {
namespace {

constexpr size_t name_columns = 30;
constexpr size_t most_text_columns = 80, least_text_columns = 40;

size_t text_columns() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return most_text_columns;
  return std::clamp(std::max<size_t>(size.ws_col, name_columns) - name_columns, least_text_columns,
                    most_text_columns);
}

// Line breaks between words, so that no line is longer than `columns`.
std::string wrapped(const std::string& text, size_t indent = name_columns) {
  static const size_t room = text_columns() + name_columns;
  const size_t columns = room - indent;
  std::istringstream words(text);
  std::string result, word;
  for (size_t column = 0; words >> word; column += word.size()) {
    if (column > 0 && column + 1 + word.size() > columns) {
      result += '\n';
      column = 0;
    } else if (column > 0) {
      result += ' ';
      ++column;
    }
    result += word;
  }
  return result;
}

// The folder of README.md, docs/ and scenes/ that belong to this program; empty where they were not
// installed.
std::filesystem::path documents() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  for (const std::string_view way : {build::documents_from_built(), build::documents_from_installed()}) {
    std::filesystem::path folder = (program.parent_path() / way).lexically_normal();
    if (std::filesystem::exists(folder / "docs/command-line.md", error)) return folder;
  }
  return {};
}

class HelpFormatter final : public CLI::Formatter {
 public:
  HelpFormatter() {
    column_width(name_columns);
    label("OPTIONS", "OPTION...");
    label("Positionals", "Arguments");
    label("REQUIRED", "");
    label("SUBCOMMAND", "COMMAND");
  }
  // The option's name without the value that a flag stands for, which CLI11 adds in braces.
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    std::string name = CLI::Formatter::make_option_name(option, is_positional);
    for (size_t open; (open = name.find('{')) != std::string::npos;)
      name.erase(open, name.find('}', open) + 1 - open);
    return name;
  }
  // The description already contains the types and exclusions that CLI11 would add.
  std::string make_option_opts(const CLI::Option* option) const override {
    return option->get_option_text().empty() ? "" : " " + option->get_option_text();
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    return wrapped(description_of(*option));
  }
  std::string make_description(const CLI::App* app) const override {
    return wrapped(app->get_description(), 0) + "\n";
  }
  std::string make_subcommand(const CLI::App* command) const override {
    std::stringstream text;
    CLI::detail::format_help(text, command->get_display_name(true), wrapped(command->get_description()),
                             column_width_);
    return text.str();
  }
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    std::string text = CLI::Formatter::make_help(app, name, mode);
    for (size_t at; (at = text.find("\n\n\n")) != std::string::npos;) text.erase(at, 1);
    if (const std::filesystem::path folder = documents();
        mode == CLI::AppFormatMode::Normal && !folder.empty())
      text += "README.md, docs/ and scenes/ are in " + (folder / "").parent_path().string() + "\n";
    return text;
  }
};

}  // namespace

std::string description_of(const CLI::Option& option) {
  std::set<std::string> names;  // CLI11's set is in the order of addresses
  for (const CLI::Option* other : option.get_excludes()) names.insert(other->get_name());
  if (names.empty()) return option.get_description();
  return fmt::format("{} Not with {}.", option.get_description(), fmt::join(names, ", "));
}

std::shared_ptr<CLI::Formatter> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

}  // namespace eyeray::engine::program
