# cmake -D ROOT=… -D OUT=… -D FILES=a;b -P embed_shaders.cmake: every shader as one row of a C++ table.
set(rows "")
foreach(name IN LISTS FILES)
  file(READ ${ROOT}/${name} text)
  string(APPEND rows "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE ${OUT} "// Made by cmake/embed_shaders.cmake.
#include \"host/core/embedded_shaders.hpp\"

namespace eyeray {

static constexpr EmbeddedShader shaders[] = {
${rows}};

std::span<const EmbeddedShader> embedded_shaders() { return shaders; }

}  // namespace eyeray
")
