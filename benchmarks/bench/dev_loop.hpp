// Measures the time that `eyeray dev` takes from a save to the first new pixels.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace eyeray::engine::bench {

// The times of one save, in seconds.
struct Edit {
  double first_pixels = 0;     // from before the file is written until the page can show something new
  double first_processor = 0;  // processor seconds of the worker in that time
  double compiling = 0;        // glslang, SPIRV-Tools and the driver, until the picture is done
  double whole = 0;            // until the picture is done
  double processor = 0;        // processor seconds of the worker in that time
};

struct DevLoopReport {
  std::string device;
  std::vector<Edit> shader, scene, formula;  // edits of a shape's code, a sphere's radius, a formula's code
};

// Measures `edits` edits of each kind. A dev loop renders each of them: shader and scene edits of Whitted's
// scene at 640 × 480, and formula edits of a column at 480 × 320. Error (no_device) if there is no device.
DevLoopReport measure_dev_loop(int edits);

// A table of medians.
std::string to_text(const DevLoopReport& report);
// {"device", "shader": [{"first_pixels", "first_processor", "compiling", "whole", "processor"}, …],
// "scene": […], "formula": […]}, in seconds.
nlohmann::ordered_json to_json(const DevLoopReport& report);

}  // namespace eyeray::engine::bench
