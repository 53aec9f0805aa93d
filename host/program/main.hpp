// The parts that all our programs share around their command lines.
#pragma once

#include <functional>
#include <string>

namespace eyeray::engine::program {

// Runs a program's command line, which returns the exit code. Turns every way in which it can fail into words
// on standard error and an exit code; under --json into JSON on standard output, too. To be called first: it
// may start the program anew (huge_pages.hpp).
int run_main(int argc, char** argv, const std::string& name,
             const std::function<int(int, char**)>& command_line);

// Warns of caches that do not work, for commands with a device.
void warn_of_caches();

}  // namespace eyeray::engine::program
