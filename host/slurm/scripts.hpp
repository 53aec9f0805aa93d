// The shell scripts that Slurm's jobs run.
#pragma once

#include <string>
#include <vector>

#include "host/slurm/array_render.hpp"

namespace eyeray::slurm {

// Renders one share: its number is the task's and the script's argument. It goes on from a checkpoint that a
// job before it left, and leaves NUMBER.failed with the code, the node and the words where it fails.
std::string share_script(const ArrayRequest& request);
// Merges the parts, and leaves `merged` or merge.failed.
std::string merge_script(const ArrayRequest& request);

}  // namespace eyeray::slurm
