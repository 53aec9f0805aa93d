#pragma once

#include <string>

namespace eyeray::engine {

// Names what the C library's functions of float64 answer here, so that equal names mean, as far as a few
// thousand arguments tell, equal bits: libraries differ in the last place, and one library between processors
// with and without FMA. A scene's transforms, its packed records and the reference's pictures go through
// them.
std::string host_arithmetic();

}  // namespace eyeray::engine
