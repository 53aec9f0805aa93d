// What a failed comparison leaves behind, so that it can be looked into.
#pragma once

#include <filesystem>
#include <span>

#include "host/compare/report.hpp"

namespace eyeray::verify {

// Writes into `folder` (made where missing) every frame as NAME.pfm, its difference from the last frame as
// NAME-difference.png in false colour, and the command line as command.txt. `frames` are those of the
// report's participants. Error (file_io) when that fails.
void keep_evidence(const std::filesystem::path& folder, std::span<const compare::Frame> frames,
                   const compare::Report& report);

}  // namespace eyeray::verify
