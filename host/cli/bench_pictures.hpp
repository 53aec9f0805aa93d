// Whole pictures: every run a process of its own, contenders in turns, POV-Ray among them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/cli/json.hpp"

namespace eyeray::cli {

struct PictureOptions {
  std::vector<std::string> backends{"gpu"};
  std::vector<std::string> defines;  // -D of render
  std::string device = "auto";
  int width = 1024;
  int height = 1024;
  int samples = 1;
  int runs = 5;
  bool povray = true;                  // where it is installed, and the scene is there as .pov too
  std::filesystem::path povray_scene;  // where none is beside the scene; may be empty
  bool start = true;                   // also cold and warm starts
  uint64_t primitives = 0;             // of the scene, to say what memory each takes; 0: not said
};

// Measures the scene file, called `name` in the report; prints the table where told to. Error when a run
// fails.
Json measure_pictures(const std::string& name, const std::filesystem::path& scene,
                      const PictureOptions& options, bool print);

}  // namespace eyeray::cli
