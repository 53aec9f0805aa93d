#pragma once

#include <string>

namespace eyeray {

// Names the program that runs, so that equal names mean equal machine code: the build ID that the linker made
// of its contents, which a package keeps, in hexadecimal; without one the hash of its file (Error (file_io)
// when that cannot be read).
std::string build_id();

}  // namespace eyeray
