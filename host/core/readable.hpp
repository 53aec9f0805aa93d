// Numbers as people read them.
#pragma once

#include <string>

namespace eyeray::engine {

// "12.3 Mrays/s".
std::string format_rate(double rays_per_second);
// "1.25 s", "3.4 ms", "2 min 5 s".
std::string format_seconds(double seconds);

}  // namespace eyeray::engine
