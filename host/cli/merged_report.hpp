// Reports of `verify --shard` put together.
#pragma once

#include <string>
#include <vector>

#include "host/program/json.hpp"
#include "host/render/tiling.hpp"

namespace eyeray::engine::cli {

using program::Json;

// A report's entry on its share: the number of scenes, and the text that names the suite and its options.
Json shard_of_report(const render::Shard& shard, size_t scenes, const std::string& suite);

// The report of all scenes, in their order, as one machine writes it. Error (bad_input) that names files
// where shares are missing, doubled or of another suite; Error (file_io) where one cannot be read or is no
// report.
Json merged_report(const std::vector<std::string>& files);

}  // namespace eyeray::engine::cli
