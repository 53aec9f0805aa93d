// Checks of an OpenEXR file before the library reads it.
#pragma once

#include <string_view>

namespace eyeray::engine::image {

// True if every attribute of every header has the size of its type, and fits in the file. The library does
// not check the stated sizes: it allocates that much memory, and reads on after that many bytes.
bool exr_header_sound(std::string_view bytes);

}  // namespace eyeray::engine::image
