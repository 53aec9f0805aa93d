# cmake -D GIT=… -D SOURCE=… -D COMPILER=… -D INSTALLED=… -D TREE=… -D VERSION=… -D OUTPUT=… -P write_build_facts.cmake: OUTPUT defines
# host/build/build_facts.hpp. A clone that only surrounds SOURCE, for example if a source package was unpacked inside it, belongs to another project.
set(commit "")
if(GIT)
  execute_process(COMMAND ${GIT} rev-parse --show-toplevel WORKING_DIRECTORY ${SOURCE}
    OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(REAL_PATH "${SOURCE}" real)
  if("${top}" STREQUAL "${real}")
    execute_process(COMMAND ${GIT} rev-parse --verify --short=12 HEAD WORKING_DIRECTORY ${SOURCE}
      OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
endif()
include(${CMAKE_CURRENT_LIST_DIR}/program_sources.cmake)
program_sources(sources ${SOURCE})
set(sums "${COMPILER}")
foreach(source IN LISTS sources)
  file(SHA256 ${SOURCE}/${source} sum)
  string(APPEND sums "\n${source} ${sum}")
endforeach()
string(SHA256 sum "${sums}")
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "host/build/build_facts.hpp"

namespace eyeray::engine::build {

std::string_view version() {
  return "@VERSION@";
}
std::string_view commit() {
  return "@commit@";
}
std::string_view sum_of_sources() {
  return "@sum@";
}
std::string_view documents_from_installed() {
  return "@INSTALLED@";
}
std::string_view documents_from_built() {
  return "@TREE@";
}

}  // namespace eyeray::engine::build
]])
