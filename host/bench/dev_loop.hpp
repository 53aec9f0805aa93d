// How long `eyeray dev` takes from a save to the first new pixels.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace eyeray::bench {

// One save, in seconds.
struct Edit {
  double first_pixels = 0;  // from before the file is written until the page can show something new
  double compiling = 0;     // of these glslang, SPIRV-Tools and the driver
  double whole = 0;         // until the picture is done
};

struct DevLoopReport {
  std::string device;
  std::vector<Edit> shader, scene;  // of a shape's code; of a sphere's radius
};

// So many edits of each kind, of Whitted's scene at 640 × 480, by a dev loop of its own. Error (no_device)
// where there is none.
DevLoopReport measure_dev_loop(int edits);

// A table of medians.
std::string to_text(const DevLoopReport& report);
// {"device", "shader": [{"first_pixels", "compiling", "whole"}, …], "scene": […]}, seconds.
nlohmann::ordered_json to_json(const DevLoopReport& report);

}  // namespace eyeray::bench
