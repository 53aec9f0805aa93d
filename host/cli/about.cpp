// eyeray completion, eyeray manual: the program's options, for shells and for man.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/option_table.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/make_folder.hpp"
#include "host/program/option_values.hpp"

namespace eyeray::engine::cli {
namespace {

ExitCode print_completion(const CLI::App& app, const std::string& shell) {
  const CommandRow table = option_table(app);
  fmt::print("{}", shell == "bash"  ? bash_completion(table)
                   : shell == "zsh" ? zsh_completion(table)
                                    : fish_completion(table));
  return ExitCode::ok;
}

ExitCode print_reference(const CLI::App& app) {
  fmt::print("{}", option_reference(option_table(app)));
  return ExitCode::ok;
}

ExitCode write_manual(const CLI::App& app, const std::filesystem::path& folder) {
  if (folder.empty()) throw Error(ExitCode::bad_input, "no folder given (see eyeray manual --help)");
  make_folder(folder);
  const CommandRow table = option_table(app);
  for (const CommandRow* each : all_commands(table))
    write_file_atomically(folder / man_page_name(*each), man_page(*each));
  return ExitCode::ok;
}

}  // namespace

void add_completion(CLI::App& app, Run& run) {
  CLI::App* const command =
      app.add_subcommand("completion", "Print a script that completes command lines in a shell.");
  const auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "bash, zsh or fish.")
      ->required()
      ->check(one_of({"bash", "zsh", "fish"}));
  command->footer(
      "Examples (Debian's package does this):\n"
      "  eyeray completion bash > ~/.local/share/bash-completion/completions/eyeray\n"
      "  eyeray completion zsh > ~/.zsh/_eyeray          in a folder of $fpath\n"
      "  eyeray completion fish > ~/.config/fish/completions/eyeray.fish");
  command->callback([&app, shell, &run] { run = [&app, shell] { return print_completion(app, *shell); }; });
}

void add_manual(CLI::App& app, Run& run) {
  CLI::App* const command =
      app.add_subcommand("manual", "Write a man page for each command, or print one page of all.");
  const auto folder = std::make_shared<std::string>();
  const auto markdown = std::make_shared<bool>(false);
  CLI::Option* const target =
      command->add_option("FOLDER", *folder, "The folder to write eyeray.1, eyeray-render.1 and so on to.");
  command->add_flag("--markdown", *markdown, "Print one page of all commands and options, as Markdown.")
      ->excludes(target);
  command->footer("Example:\n  eyeray manual man1 && man man1/eyeray-render.1");
  command->callback([&app, folder, markdown, &run] {
    run = [&app, folder, markdown] { return *markdown ? print_reference(app) : write_manual(app, *folder); };
  });
}

}  // namespace eyeray::engine::cli
