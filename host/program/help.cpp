#include "host/program/help.hpp"

#include <filesystem>
#include <sstream>

#include "host/build/build_facts.hpp"

namespace eyeray::program {
namespace {

constexpr size_t name_columns = 30;
constexpr size_t text_columns = 80;

// Line breaks between words, so that no line is longer than `columns`.
std::string wrapped(const std::string& text, size_t columns) {
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
  // Without the value that a flag stands for, which CLI11 puts in braces.
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    std::string name = CLI::Formatter::make_option_name(option, is_positional);
    for (size_t open; (open = name.find('{')) != std::string::npos;)
      name.erase(open, name.find('}', open) + 1 - open);
    return name;
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    return wrapped(option->get_description(), text_columns);
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

std::shared_ptr<CLI::Formatter> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

}  // namespace eyeray::program
