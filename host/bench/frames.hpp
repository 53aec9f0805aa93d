// What frames of an animation cost together, in one process, beside each in a process of its own.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace eyeray::bench {

struct FramesReport {
  // Seconds, from the start of the first process to the end of the last.
  struct Cost {
    double wall = 0;
    double processor = 0;  // of all threads
  };
  std::string scene;
  int frames = 0;
  Cost together;
  Cost apart;
};

// Of `frames` frames from 0 on. Caches are the user's, and warm. Error when a run fails.
FramesReport measure_frames(const std::filesystem::path& scene, int frames,
                            const std::vector<std::string>& defines);

std::string to_text(const FramesReport& report);
nlohmann::ordered_json to_json(const FramesReport& report);

}  // namespace eyeray::bench
