// The C++ compiler that the machine has, and how it makes a module of shaders for debuggers.
#pragma once

#include <string>
#include <vector>

#include "host/core/process.hpp"

namespace eyeray::engine::executors {

// $CXX, else the first of c++, g++ and clang++ in $PATH, as the words of a command; empty: there is none.
std::vector<std::string> cpp_compiler();
// The command of cpp_compiler(). Error (bad_input) if there is no compiler.
std::vector<std::string> require_cpp_compiler();

// The flags that compile a shared object with full debug information, $CXXFLAGS included, and with the float
// policy of our own code. `sanitizers`: as -fsanitize takes them; empty: none.
std::vector<std::string> module_flags(const std::vector<std::string>& compiler,
                                      const std::string& sanitizers);

// The compiler's environment, without the libraries that are preloaded for a module.
Environment compiler_environment();

// The environment that a process needs from its start if its module has these sanitizers. Error (bad_input)
// if there is no compiler, or if it lacks a sanitizer.
Environment sanitizer_environment(const std::string& sanitizers);

}  // namespace eyeray::engine::executors
