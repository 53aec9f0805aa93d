# cmake -D OUT=… -D FUNCTION=embedded_shaders -D NAMES=a;b -D PATHS=/…/a;/…/b -P embed_shaders.cmake: texts as rows of a C++ table.
set(rows "")
foreach(name path IN ZIP_LISTS NAMES PATHS)
  file(READ ${path} text)
  string(APPEND rows "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE ${OUT} "// Made by cmake/embed_shaders.cmake.
#include \"host/core/embedded_shaders.hpp\"

namespace eyeray {

static constexpr EmbeddedShader files[] = {
${rows}};

std::span<const EmbeddedShader> ${FUNCTION}() { return files; }

}  // namespace eyeray
")
