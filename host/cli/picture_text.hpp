// The text that commands print about a picture that they made.
#pragma once

#include <string>

#include "host/program/json.hpp"
#include "host/session/result.hpp"

namespace eyeray::engine::cli {

// `parts`: of how many a picture was merged; 0 where it was rendered.
// "whitted.png: 640×480, 4 samples a pixel, 1200000 rays in 0.35 s (3.43 Mrays/s), 0.8 s in all, on gpu: …".
// The rays divided by their seconds are the rate.
std::string summary(const session::Result& picture, size_t parts = 0);
program::Json json_of(const session::Result& picture, size_t parts = 0);

// Its warnings, a line each on stderr.
void print_warnings(const session::Result& picture);

}  // namespace eyeray::engine::cli
