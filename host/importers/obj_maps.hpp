// The options of maps in .mtl files. Private to the importers.
#pragma once

#include <string>
#include <string_view>

namespace eyeray::engine::importers {

// The text of a .mtl file with each option of a map completed to its full count of numbers. `-s`, `-o` and
// `-t` may have one to three numbers, `-mm` one or two; tinyobjloader takes the file's name for a missing
// number. Source: Alias|Wavefront: Object Files, B1, "Options for texture map statements".
std::string with_all_map_numbers(std::string_view mtl);

}  // namespace eyeray::engine::importers
