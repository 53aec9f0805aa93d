# cmake -D IN=… -D OUT=… -P embed_page.cmake: the page of a report as a C++ string.
file(READ ${IN} text)
file(WRITE ${OUT} "// Made by cmake/embed_page.cmake.
#include <string_view>

namespace eyeray::verify {

extern const std::string_view page_template;
const std::string_view page_template = R\"page(${text})page\";

}  // namespace eyeray::verify
")
