#include "host/program/usage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "host/build/build_facts.hpp"
#include "host/core/diagnostic.hpp"
#include "host/core/error.hpp"
#include "host/core/text_scanner.hpp"
#include "host/program/help.hpp"

namespace eyeray::engine::program {
namespace {

// "check ", "generate terrain ": how the command is named after the program's own name.
std::string words_before(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent ? words_before(*parent) + command.get_name() + " " : "";
}

// The parts of a text that the `*`s of `pattern` stand for; nothing if the text is of another form.
std::vector<std::string> parts(std::string_view text, std::string_view pattern) {
  std::vector<std::string> found;
  TextScanner rest(text), fixed(pattern);
  if (!rest.skip(*fixed.before("*"))) return {};
  while (const auto next = fixed.before("*")) {
    const auto part = rest.before(*next);
    if (!part) return {};
    found.emplace_back(*part);
  }
  if (!rest.rest().ends_with(fixed.rest())) return {};
  found.emplace_back(rest.rest().substr(0, rest.rest().size() - fixed.rest().size()));
  return found;
}

// CLI11's message in plain words.
std::string plain_words(const std::string& text) {
  static constexpr std::pair<const char*, const char*> rules[] = {
      {"*: 1 required * missing", "{} needs a value"},
      {"*: At Most 1 required but received *", "{} is given {} times"},
      {"* was given a disallowed flag override", "--{} takes no value"},
      {"* excludes *", "{} and {} exclude each other"},
      {"Could not convert: * = *", "{} does not take the value '{}'"},
      {"*: must be *", "{} must be {}"}};  // the texts of option_values.hpp, which follow the option's name
  for (const auto& [pattern, words] : rules) {
    const std::vector<std::string> found = parts(text, pattern);
    if (found.empty()) continue;
    return fmt::format(fmt::runtime(words), found.front(), found.back());
  }
  return text;
}

// The option that is meant by other programs' name for it; else the name.
std::string own_name(const std::string& option) {
  constexpr std::pair<std::string_view, const char*> foreign[] = {
      {"--samples", "--spp"}, {"--width", "--size"}, {"--height", "--size"}, {"--resolution", "--size"}};
  for (const auto& [name, own] : foreign)
    if (option == name) return own;
  return option;
}

// One line about an option with one dash that CLI11 reads as another; "" if there is none. It reads -spp as
// -s with the value "pp", and -q=3, where -q is a flag, as the flags -q, -= and -3.
std::string single_dash_message(const CLI::App& app, std::span<char* const> words) {
  const CLI::App& command = named_command(app);
  for (const std::string_view word : words) {
    const std::string name(word.substr(0, word.find('=')));
    if (name.size() < 2 || name[0] != '-' || name[1] == '-') continue;
    if (name.size() == 2) {
      const CLI::Option* const flag = word.size() > 2 ? command.get_option_no_throw(name) : nullptr;
      if (flag && flag->get_items_expected_min() == 0)
        return fmt::format("{} takes no value: write {} (see {} {}--help)", name, name, app.get_name(),
                           words_before(command));
      continue;
    }
    const std::string meant = own_name("-" + name);
    if (command.get_option_no_throw(meant))
      return fmt::format("unknown option '{}'; did you mean '{}'? (see {} {}--help)", name, meant,
                         app.get_name(), words_before(command));
  }
  return "";
}

// One line about a wrong command line, with the name that was probably meant.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = named_command(app);
  const std::string help = fmt::format("(see {} {}--help)", app.get_name(), words_before(command));
  const std::vector<std::string> extras = app.remaining(true);
  if (!dynamic_cast<const CLI::ExtrasError*>(&error) || extras.empty())
    return fmt::format("{} {}", plain_words(error.what()), help);

  // Look for the nearest name of the same kind: option or command.
  std::string word = extras[0];
  const bool is_option = word.starts_with('-');
  if (is_option) word = word.substr(0, word.find('='));
  std::vector<std::string> names;
  if (is_option) {
    for (const CLI::Option* option : command.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
  } else {
    for (const CLI::App* each : command.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(each->get_name());
  }
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  if (std::find(names.begin(), names.end(), word) != names.end())
    return fmt::format("'{}' belongs after the command: {} {}... {} {}", word, app.get_name(),
                       words_before(command), word, help);
  const std::string nearest = nearest_name(is_option ? own_name(word) : word, candidates);
  const char* kind = is_option ? "unknown option" : names.empty() ? "unexpected argument" : "unknown command";
  return fmt::format("{} '{}'{} {}", kind, word,
                     nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest), help);
}

std::string version(const std::string& name) {
  const std::string_view built_from = build::commit();
  return name + " " EYERAY_VERSION + (built_from.empty() ? "" : fmt::format(" (commit {})", built_from));
}

}  // namespace

void describe(CLI::App& app, const std::string& name, const std::string& text, const std::string& footer) {
  app.name(name);
  app.description(text);
  app.set_version_flag("--version", version(name),
                       "Print the version, and the commit that it was built from.");
  app.set_help_flag("-h,--help", "Print this help.");
  app.formatter(help_formatter());
  app.option_defaults()->disable_flag_override();
  app.footer(footer);
}

const CLI::App& named_command(const CLI::App& app) {
  const std::vector<const CLI::App*> named =
      app.get_subcommands([](const CLI::App* command) { return command->parsed() > 0; });
  return named.empty() ? app : named_command(*named[0]);
}

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  const std::span<char* const> words(argv + 1, size_t(std::max(argc, 1) - 1));
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    std::ostringstream text;
    const int code = app.exit(success, text, text);
    fmt::print("{}", text.str());
    return code;
  } catch (const CLI::ParseError& error) {
    const std::string message = single_dash_message(app, words);
    throw Error(ExitCode::bad_input, message.empty() ? usage_message(app, error) : message);
  }
  if (const std::string message = single_dash_message(app, words); !message.empty())
    throw Error(ExitCode::bad_input, message);
  return std::nullopt;
}

}  // namespace eyeray::engine::program
