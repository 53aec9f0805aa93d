// The files that a failed comparison leaves behind, so that people can investigate it.
#pragma once

#include <filesystem>
#include <span>

#include "host/compare/report.hpp"

namespace eyeray::engine::verify {

// Writes into `folder` (made where missing) every frame as NAME.pfm, its difference from the last frame as
// NAME-difference.png in false colour, the causes of differing pixels as NAME-causes.png and .json
// (cause_picture.hpp), golden-difference.png where there is a golden picture, and the command line as
// command.txt. `frames` are those of the report's participants;
// `outcomes` those of all frames but the last, empty if there was nothing to compare. Error (file_io) if a
// file cannot be written.
void keep_evidence(const std::filesystem::path& folder, std::span<const compare::Frame> frames,
                   std::span<const std::vector<compare::PixelOutcome>> outcomes,
                   const compare::Report& report);

}  // namespace eyeray::engine::verify
