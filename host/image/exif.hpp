// The orientation that a camera wrote into a JPEG.
#pragma once

#include <span>

#include "host/image/coded_image.hpp"

namespace eyeray::image {

// 1 … 8, as EXIF numbers them; 1, upright, where the file says nothing that can be read.
// Source: CIPA DC-008 (Exif 2.3), tag 0x0112 of the first directory.
int exif_orientation(std::span<const std::byte> jpeg);

// The picture as it is to be seen, from one that was stored with this orientation.
CodedImage upright(CodedImage image, int orientation);

}  // namespace eyeray::image
