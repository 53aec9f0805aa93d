#pragma once

#include <string>

namespace eyeray::engine {

// Names the results of the C library's float64 functions on this machine. Equal names mean equal bits, as far
// as a few thousand arguments show. Libraries differ in the last place, and one library differs between
// processors with and without FMA. A scene's transforms, its packed records and the reference's pictures
// depend on these functions.
std::string host_arithmetic();

}  // namespace eyeray::engine
