// eyeray: reads the command line, runs one command, and turns whatever goes wrong into words and an exit
// code.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <regex>
#include <span>
#include <sstream>
#include <system_error>

#include "host/cli/build_facts.hpp"
#include "host/cli/command.hpp"
#include "host/cli/help.hpp"
#include "host/cli/huge_pages.hpp"
#include "host/cli/json.hpp"
#include "host/core/diagnostic.hpp"
#include "host/core/disk_cache.hpp"
#include "host/core/memory_shortage.hpp"
#include "host/core/standard_streams.hpp"
#include "host/core/termination.hpp"
#include "host/gpu/vector_width.hpp"

namespace eyeray::cli {
namespace {

std::string version() {
  const std::string_view built_from = commit();
  return "eyeray " EYERAY_VERSION + (built_from.empty() ? "" : fmt::format(" (commit {})", built_from));
}

void describe(CLI::App& app) {
  app.name("eyeray");
  app.description("eyeray: a ray tracer on Vulkan compute shaders, checked pixel by pixel against the CPU.");
  app.set_version_flag("--version", version(), "Print the version, and the commit that it was built from.");
  app.set_help_flag("-h,--help", "Print this help; every command has its own.");
  app.formatter(help_formatter());
  app.footer(
      "First picture:   eyeray render scenes/whitted.toml -o whitted.png\n"
      "Proof:           eyeray verify scenes/whitted.toml\n"
      "Exit codes: 0 ok, 1 a comparison failed, 2 bad usage, scene or shader, 3 no usable Vulkan device,\n"
      "            4 file input or output, 5 time-out, 6 a checkpoint that nothing goes on from,\n"
      "            128 + N ended by signal N.\n"
      "Data goes to standard output, words to standard error. Under --json a failure is JSON too: "
      "{\"error\": ...}.");
}

// The command that was named, down to its own subcommand; the app itself when there was none.
const CLI::App& named_command(const CLI::App& app) {
  const std::vector<const CLI::App*> named =
      app.get_subcommands([](const CLI::App* command) { return command->parsed() > 0; });
  return named.empty() ? app : named_command(*named[0]);
}

// "check ", "generate terrain ": how the command is named after the program's own name.
std::string words_before(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent ? words_before(*parent) + command.get_name() + " " : "";
}

// What CLI11 says of values, in plain words.
std::string plain_words(const std::string& text) {
  static const std::regex missing(R"(^(.+): 1 required \w+ missing$)");
  static const std::regex not_among(R"(^(.+): (.*) not in \{(.*)\}$)");
  std::smatch match;
  if (std::regex_match(text, match, missing)) return fmt::format("{} needs a value", match[1].str());
  if (!std::regex_match(text, match, not_among)) return text;
  return fmt::format("{} is one of {}, not '{}'", match[1].str(),
                     std::regex_replace(match[3].str(), std::regex(","), ", "), match[2].str());
}

// The option that is meant by other programs' name for it; else the name.
std::string own_name(const std::string& option) {
  constexpr std::pair<std::string_view, const char*> foreign[] = {
      {"--samples", "--spp"}, {"--width", "--size"}, {"--height", "--size"}, {"--resolution", "--size"}};
  for (const auto& [name, own] : foreign)
    if (option == name) return own;
  return option;
}

// One line about a long option that is written with one dash, as other programs have it, and which CLI11
// reads as -s with the value "pp"; "" if there is none.
std::string single_dash_message(const CLI::App& app, std::span<char* const> words) {
  const CLI::App& command = named_command(app);
  for (const std::string_view word : words) {
    const std::string name(word.substr(0, word.find('=')));
    if (name.size() < 3 || name[0] != '-' || name[1] == '-') continue;
    const std::string meant = own_name("-" + name);
    if (command.get_option_no_throw(meant))
      return fmt::format("unknown option '{}'; did you mean '{}'? (see eyeray {}--help)", name, meant,
                         words_before(command));
  }
  return "";
}

// One line about a wrong command line, with the name that was probably meant.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = named_command(app);
  const std::string help = fmt::format("(see eyeray {}--help)", words_before(command));
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
    return fmt::format("'{}' belongs after the command: eyeray {}... {} {}", word, words_before(command),
                       word, help);
  const std::string nearest = nearest_name(is_option ? own_name(word) : word, candidates);
  const char* kind = is_option ? "unknown option" : names.empty() ? "unexpected argument" : "unknown command";
  return fmt::format("{} '{}'{} {}", kind, word,
                     nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest), help);
}

// Says why the program ends, once: what ends it and what that brings about may both have a word.
void report(const Error& error, bool json) {
  static std::atomic_flag said;
  if (said.test_and_set()) return;
  if (json) print_json({{"error", to_json(error)}});
  if (const auto* input = dynamic_cast<const InputError*>(&error)) {
    const size_t count = input->diagnostics().size();
    print_lines(stderr, "{}\n{} error{}\n", input->what(), count, count == 1 ? "" : "s");
  } else {
    print_lines(stderr, "eyeray: error: {}\n", error.what());
  }
}

// Once for all that is cached by a command with a device. The worker of dev is another process of one
// command.
void warn_of_caches(const CLI::App& command) {
  const CLI::Option* const worker = command.get_option_no_throw("--worker-socket");
  if (!command.get_option_no_throw("--device") || (worker && worker->count() > 0)) return;
  std::vector<std::string> warnings = DiskCache::of_user().warnings();
  if (std::string warning = gpu::driver_cache_warning(); !warning.empty())
    warnings.push_back(std::move(warning));
  for (const std::string& warning : warnings) print_lines(stderr, "eyeray: warning: {}\n", warning);
}

// The words behind -- of `eyeray slurm`, which are sbatch's; they are taken off argc.
std::vector<std::string> take_sbatch_words(int& argc, char** argv) {
  std::vector<std::string> words;
  if (argc < 2 || std::string_view(argv[1]) != "slurm") return words;
  for (int i = 2; i < argc; ++i) {
    if (std::string_view(argv[i]) != "--") continue;
    words.assign(argv + i + 1, argv + argc);
    argc = i;
  }
  return words;
}

int run_command_line(int argc, char** argv) {
  const std::vector<std::string> sbatch_words = take_sbatch_words(argc, argv);
  const std::span<char* const> words(argv + 1, size_t(std::max(argc, 1) - 1));
  CLI::App app;
  describe(app);
  Run run;
  add_render(app, run);
  add_merge(app, run);
  add_verify(app, run);
  add_compare(app, run);
  add_probe(app, run);
  add_check(app, run);
  add_dev(app, run);
  add_devices(app, run);
  add_bench(app, run);
  add_generate(app, run);
  add_shaders(app, run);
  add_slurm(app, run, sbatch_words);
  add_new(app, run);
  add_completion(app, run);
  add_manual(app, run);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    std::ostringstream text;
    const int code = app.exit(asked, text, text);
    fmt::print("{}", text.str());
    return code;
  } catch (const CLI::ParseError& error) {
    const std::string message = single_dash_message(app, words);
    throw Error(ExitCode::bad_input, message.empty() ? usage_message(app, error) : message);
  }
  if (const std::string message = single_dash_message(app, words); !message.empty())
    throw Error(ExitCode::bad_input, message);
  if (!run) {
    fmt::print(stderr, "{}", app.help());
    return int(ExitCode::bad_input);
  }
  warn_of_caches(named_command(app));
  return exit_status(run());
}

// Every way in which a command can fail, as an exit code.
int guarded_main(int argc, char** argv) {
  make_standard_streams_safe();
  const bool json =
      std::any_of(argv + 1, argv + argc, [](std::string_view word) { return word == "--json"; });
  try {
    watch_for_termination([json](const Error& error) { report(error, json); });
    report_memory_shortage();
    const int code = run_command_line(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      throw Error(ExitCode::file_io, "cannot write to standard output: {}", strerror(errno));
    return code;
  } catch (const Error& error) {
    report(error, json);
    return exit_status(error.code());
  } catch (const std::bad_alloc&) {
    report(out_of_memory(), json);
    return int(out_of_memory().code());
  } catch (const std::filesystem::filesystem_error& error) {
    report({ExitCode::file_io, "cannot make or read {}: {}", error.path1().string(), error.code().message()},
           json);
    return int(ExitCode::file_io);
  } catch (const std::system_error& error) {
    // fmt does not name the stream.
    if (std::ferror(stdout))
      report({ExitCode::file_io, "cannot write to standard output: {}", error.code().message()}, json);
    else
      report({ExitCode::file_io, "{}", error.what()}, json);
    return int(ExitCode::file_io);
  } catch (const std::exception& error) {
    report(own_fault(error.what()), json);
    return int(ExitCode::internal);
  }
}

}  // namespace
}  // namespace eyeray::cli

int main(int argc, char** argv) {
  eyeray::cli::use_huge_pages(argv);
  return eyeray::cli::guarded_main(argc, argv);
}
