// The text that commands print about a picture that they made.
#pragma once

#include <string>

#include "host/program/json.hpp"
#include "host/session/result.hpp"

namespace eyeray::engine::cli {

// "whitted.png: 640×480, 4 samples a pixel, 1200000 rays in 0.35 s (3.43 Mrays/s), 0.8 s in all, on gpu: …".
// The rate is the rays divided by their seconds. `parts`: the number of merged parts; 0 for a rendered
// picture.
std::string summary(const session::Result& picture, size_t parts = 0);
program::Json json_of(const session::Result& picture, size_t parts = 0);

// Prints the picture's warnings on stderr, a line each.
void print_warnings(const session::Result& picture);

}  // namespace eyeray::engine::cli
