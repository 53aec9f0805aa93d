// Radiance pictures (.hdr, Greg Ward's RGBE). We decode them ourselves, since Debian 12's stb_image never
// ends on a truncated file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/image/image.hpp"

namespace eyeray::engine::image {

// Decodes to 3 channels, top row first. Reads flat rows and both run-length encodings. The pixels are divided
// by the product of all EXPOSUREs and COLORCORRs, which gives the light. Unusual PRIMARIES and PIXASPECT are
// warnings; other lines of the header do not change the numbers. Error (file_io), with `name` in it, for
// anything else, and for missing or surplus bytes.
// Source: Ward: Radiance File Formats, "Picture File Format".
Image decode_radiance(std::string_view bytes, const std::string& name, std::vector<std::string>& warnings);

}  // namespace eyeray::engine::image
