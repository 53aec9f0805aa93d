#include "host/cli/help.hpp"

#include <sstream>

namespace eyeray::cli {
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

class HelpFormatter final : public CLI::Formatter {
 public:
  HelpFormatter() {
    column_width(name_columns);
    label("OPTIONS", "OPTION...");
    label("Positionals", "Arguments");
    label("REQUIRED", "");
    label("SUBCOMMAND", "COMMAND");
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    return wrapped(option->get_description(), text_columns);
  }
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    std::string text = CLI::Formatter::make_help(app, name, mode);
    for (size_t at; (at = text.find("\n\n\n")) != std::string::npos;) text.erase(at, 1);
    return text;
  }
};

}  // namespace

std::shared_ptr<CLI::Formatter> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

}  // namespace eyeray::cli
