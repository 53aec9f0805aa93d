// A command line as CLI11 reads it, with mistakes in plain words.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace eyeray::engine::program {

// The output of --help and --version.
void describe(CLI::App& app, const std::string& name, const std::string& text, const std::string& footer);

// Parses a command line. Returns the exit code if --help or --version has answered it already. Error
// (bad_input) for a mistake, with the name that was probably meant.
std::optional<int> parse(CLI::App& app, int argc, char** argv);

// The command that was named, down to its own subcommand; the app itself when there was none.
const CLI::App& named_command(const CLI::App& app);

}  // namespace eyeray::engine::program
