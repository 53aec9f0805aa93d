// Facts of the build, which cmake/build_facts.cmake writes into a file of their own.
#pragma once

#include <string_view>

namespace eyeray::engine::build {

// "0.1.0".
std::string_view version();
// The abbreviated hash of the commit that the program was built from; "" where the sources were no git clone.
std::string_view commit();
// Names the origin of the program's bits: a sum of its sources, its compiler and the compiler's flags. The
// commit and the folder of the build are no part of it.
std::string_view sum_of_sources();
// The folder of README.md, docs/ and scenes/ relative to the folder of the program, installed or as it was
// built.
std::string_view documents_from_installed();
std::string_view documents_from_built();

}  // namespace eyeray::engine::build
