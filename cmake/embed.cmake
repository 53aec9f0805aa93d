# eyeray_embed(TARGET FUNCTION NAMES PATHS): embeds the files PATHS in the target by the names NAMES: `std::span<const EmbeddedFile> FUNCTION()` returns them
# (host/core/embedded_file.hpp). eyeray_embed_folder(TARGET FUNCTION FOLDER): embeds all files of a folder, by their paths below it.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  function(eyeray_embed target function names paths)
    string(REPLACE "::" "_" file ${function})
    set(out ${CMAKE_BINARY_DIR}/generated/${file}.cpp)
    set(script ${CMAKE_SOURCE_DIR}/cmake/embed.cmake)
    add_custom_command(
      OUTPUT ${out}
      COMMAND ${CMAKE_COMMAND} -D OUT=${out} -D FUNCTION=${function} "-D NAMES=${names}" "-D PATHS=${paths}" -P ${script}
      DEPENDS ${paths} ${script}
      COMMENT "Embedding ${function}" VERBATIM)
    target_sources(${target} PRIVATE ${out})
  endfunction()
  function(eyeray_embed_folder target function folder)
    set(root ${CMAKE_SOURCE_DIR}/${folder})
    file(GLOB_RECURSE names CONFIGURE_DEPENDS RELATIVE ${root} ${root}/*)
    list(TRANSFORM names PREPEND ${root}/ OUTPUT_VARIABLE paths)
    eyeray_embed(${target} ${function} "${names}" "${paths}")
  endfunction()
  return()
endif()

string(REGEX MATCH "^(.*)::([a-z_]+)$" whole ${FUNCTION})
set(NAMESPACE ${CMAKE_MATCH_1})
set(FUNCTION ${CMAKE_MATCH_2})
set(rows "")
foreach(name path IN ZIP_LISTS NAMES PATHS)
  file(READ ${path} text)
  string(APPEND rows "    {\"${name}\"sv, R\"text(${text})text\"sv},\n")
endforeach()
file(WRITE ${OUT} "// Made by cmake/embed.cmake.
#include <span>

#include \"host/core/embedded_file.hpp\"

// Literals know their length: counting it is more than Clang does for a constant.
using namespace std::string_view_literals;

static constexpr eyeray::engine::EmbeddedFile files[] = {
${rows}};

namespace ${NAMESPACE} {
std::span<const EmbeddedFile> ${FUNCTION}();
std::span<const EmbeddedFile> ${FUNCTION}() { return files; }
}  // namespace ${NAMESPACE}
")
