// Checks of an OpenEXR file before the library reads it.
#pragma once

#include <string_view>

namespace eyeray::engine::image {

// True if every attribute of every header has the size that its type has, and fits in the file. The library
// believes each, takes memory for its claim, and reads on from where it ends.
bool exr_header_sound(std::string_view bytes);

}  // namespace eyeray::engine::image
