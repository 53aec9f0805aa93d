# eyeray_embed_files(TARGET FUNCTION FOLDER FILE…): the target has the files of FOLDER (host/core/embedded_file.hpp), as what FUNCTION gives,
# `std::span<const EmbeddedFile> FUNCTION()`.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  function(eyeray_embed_files target function folder)
    set(root ${CMAKE_SOURCE_DIR}/${folder})
    list(TRANSFORM ARGN PREPEND ${root}/ OUTPUT_VARIABLE paths)
    string(REPLACE "::" "_" name ${function})
    set(out ${CMAKE_BINARY_DIR}/generated/${name}.cpp)
    set(script ${CMAKE_SOURCE_DIR}/cmake/embed.cmake)
    add_custom_command(
      OUTPUT ${out}
      COMMAND ${CMAKE_COMMAND} -D OUT=${out} -D FUNCTION=${function} -D ROOT=${root} "-D FILES=${ARGN}" -P ${script}
      DEPENDS ${paths} ${script}
      COMMENT "Embedding ${folder}" VERBATIM)
    target_sources(${target} PRIVATE ${out})
  endfunction()
  return()
endif()

string(REGEX MATCH "^(.*)::([a-z_]+)$" whole ${FUNCTION})
set(NAMESPACE ${CMAKE_MATCH_1})
set(FUNCTION ${CMAKE_MATCH_2})

set(rows "")
foreach(name IN LISTS FILES)
  file(READ ${ROOT}/${name} text)
  string(APPEND rows "    {\"${name}\", R\"text(${text})text\"},\n")
endforeach()
file(WRITE ${OUT} "// Made by cmake/embed.cmake.
#include <span>

#include \"host/core/embedded_file.hpp\"

static constexpr eyeray::EmbeddedFile files[] = {
${rows}};

namespace ${NAMESPACE} {
std::span<const EmbeddedFile> ${FUNCTION}();
std::span<const EmbeddedFile> ${FUNCTION}() { return files; }
}  // namespace ${NAMESPACE}
")
