// Reports of `verify --shard` put together.
#pragma once

#include <string>
#include <vector>

#include "host/program/json.hpp"
#include "host/render/tiling.hpp"

namespace eyeray::engine::cli {

using program::Json;

// A report's entry on its share. `scenes`: the number of scenes in the suite. `suite`: the text that names
// the suite and its options.
Json shard_of_report(const render::Shard& shard, size_t scenes, const std::string& suite);

// The report on all scenes, in their order, as a single machine would write it. Error (bad_input), which
// names the files, if shares are missing, doubled or of another suite. Error (file_io) if a file cannot be
// read or is no report.
Json merged_report(const std::vector<std::string>& files);

}  // namespace eyeray::engine::cli
