// Measures the cost of a picture or an animation by the number of processes that render it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace eyeray::engine::bench {

// Seconds from the start of the first process to the end of the last. The processes run one after the other.
struct ProcessCost {
  double wall = 0;
  double processor = 0;  // processor seconds of all threads
};

struct ProcessReport {
  struct Way {
    std::string key;  // in JSON
    std::string words;
    ProcessCost cost;
  };
  std::string scene;
  std::string kind;  // the counted quantity
  int count = 0;
  std::vector<Way> ways;
  ProcessCost ratio;  // ratio of one process to a process a frame, or of shards to one process
};

// Measures frames from 0 on, rendered in one process and in one process each. Both use the user's caches,
// which are warm. Error when a run fails.
ProcessReport measure_frames(const std::filesystem::path& scene, int frames,
                             const std::vector<std::string>& defines);

// Measures one picture of width × height pixels with `samples` samples each: as shards and their merge, and
// in one process.
ProcessReport measure_shards(const std::filesystem::path& scene, int shards, int width, int height,
                             int samples, const std::vector<std::string>& defines);

std::string to_text(const ProcessReport& report);
nlohmann::ordered_json to_json(const ProcessReport& report);

}  // namespace eyeray::engine::bench
