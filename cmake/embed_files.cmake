# cmake -D ROOT=… -D OUT=… -D FILES=a;b -P embed_files.cmake: the files of eyeray dev's page as rows of a C++ table.
set(rows "")
foreach(name IN LISTS FILES)
  cmake_path(GET name EXTENSION LAST_ONLY ending)
  if(ending STREQUAL ".html")
    set(type "text/html; charset=utf-8")
  elseif(ending STREQUAL ".css")
    set(type "text/css; charset=utf-8")
  elseif(ending STREQUAL ".mjs")
    set(type "text/javascript; charset=utf-8")
  elseif(ending STREQUAL ".svg")
    set(type "image/svg+xml")
  else()
    message(FATAL_ERROR "${name}: no type is known for this ending")
  endif()
  file(READ ${ROOT}/${name} text)
  string(APPEND rows "    {\"${name}\", \"${type}\", R\"page(${text})page\"},\n")
endforeach()
file(WRITE ${OUT} "// Made by cmake/embed_files.cmake.
#include \"host/dev/page_files.hpp\"

namespace eyeray::dev {

static constexpr PageFile files[] = {
${rows}};

std::span<const PageFile> page_files() { return files; }

}  // namespace eyeray::dev
")
