// Radiance pictures (.hdr, Greg Ward's RGBE). Our own, since Debian 12's stb_image never ends on a
// truncated one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/image/image.hpp"

namespace eyeray::engine::image {

// A 3-channel picture, top row first; flat rows, and both run-length encodings. The pixels are divided by the
// product of all EXPOSUREs and COLORCORRs, which gives the light. PRIMARIES and PIXASPECT that are not the
// usual ones are warnings; other lines of the header do not change the numbers. Strict: Error
// (file_io), with `name` in it, for anything else, and for a byte too few or too many.
// Source: Ward: Radiance File Formats, "Picture File Format".
Image decode_radiance(std::string_view bytes, const std::string& name, std::vector<std::string>& warnings);

}  // namespace eyeray::engine::image
