// Radiance pictures (.hdr, Greg Ward's RGBE). Our own, since Debian 12's stb_image never ends on a
// truncated one.
#pragma once

#include <string>
#include <string_view>

#include "host/image/image.hpp"

namespace eyeray::image {

// A 3-channel picture, top row first; flat and run-length encoded rows. Strict: Error (file_io), with `name`
// in it, for anything else, and for a byte too few or too many.
Image decode_radiance(std::string_view bytes, const std::string& name);

}  // namespace eyeray::image
