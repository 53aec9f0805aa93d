// How --help looks.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

namespace eyeray::program {

// Descriptions wrapped at 110 columns, one blank line between groups.
std::shared_ptr<CLI::Formatter> help_formatter();

}  // namespace eyeray::program
