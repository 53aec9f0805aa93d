// The options of maps in .mtl files. Private to the importers.
#pragma once

#include <string>
#include <string_view>

namespace eyeray::engine::importers {

// The text of a .mtl file with each option of a map followed by as many numbers as it may have. `-s`, `-o`
// and `-t` have one to three, `-mm` one or two; tinyobjloader takes the file's name for a missing number.
// Source: Alias|Wavefront: Object Files, B1, "Options for texture map statements".
std::string with_all_map_numbers(std::string_view mtl);

}  // namespace eyeray::engine::importers
