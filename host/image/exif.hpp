// The orientation that a camera wrote into a JPEG.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "host/image/coded_image.hpp"

namespace eyeray::engine::image {

// The orientation, 1 … 8, as EXIF numbers it; 1, upright, if the file has no readable orientation.
// Source: CIPA DC-008 (Exif 2.3), tag 0x0112 of the first directory.
int exif_orientation(std::span<const std::byte> jpeg);
// The orientation in a bare TIFF block, as a PNG contains it.
int tiff_orientation(std::string_view tiff);

// Calls visit(marker, content) for each segment of a JPEG before its pixels.
void for_each_jpeg_segment(std::string_view jpeg,
                           const std::function<void(uint32_t marker, std::string_view content)>& visit);

// True if the JPEG has an end marker outside its segments. A thumbnail in a segment has an end marker of its
// own, which does not count.
bool has_jpeg_end(std::string_view jpeg);

// Turns a picture that was stored with this orientation upright.
CodedImage upright(CodedImage image, int orientation);

}  // namespace eyeray::engine::image
