// The text of OBJ and MTL files, before their statements are read. Private to the importers.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace eyeray::engine::importers {

// Makes each line end with '\n': old programs end lines with '\r' alone.
void end_lines_with_newlines(std::string& text);

// The text of a .mtl file as tinyobjloader understands it: it knows neither all options nor quotes.
struct MtlText {
  std::string text;
  std::set<std::string> left_out;  // the words for a warning about each kind of text that was taken out
};

// Takes out the options of maps that have no counterpart here, `-halo` of `d`, and colours that are not RGB.
// Completes the others to their full count of numbers: `-s` and `-o` may have one to three. Takes the quotes
// from the names of pictures. Source: Alias|Wavefront: Object Files, B1, "Options for texture map
// statements".
MtlText plain_mtl(std::string_view mtl);

}  // namespace eyeray::engine::importers
