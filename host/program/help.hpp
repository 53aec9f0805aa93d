// The layout of --help.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

namespace eyeray::engine::program {

// Descriptions wrapped at the width of the terminal, at most 110 columns; one blank line between groups.
std::shared_ptr<CLI::Formatter> help_formatter();
// The option's description, with the options that it cannot be combined with.
std::string description_of(const CLI::Option& option);

}  // namespace eyeray::engine::program
