// The orientation that a camera wrote into a JPEG.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "host/image/coded_image.hpp"

namespace eyeray::engine::image {

// The orientation, 1 … 8, as EXIF numbers it; 1, upright, where the file has none that can be read.
// Source: CIPA DC-008 (Exif 2.3), tag 0x0112 of the first directory.
int exif_orientation(std::span<const std::byte> jpeg);
// The orientation in a TIFF block alone, as a PNG contains it.
int tiff_orientation(std::string_view tiff);

// Calls visit(marker, content) for each segment of a JPEG before its pixels.
void for_each_jpeg_segment(std::string_view jpeg,
                           const std::function<void(uint32_t marker, std::string_view content)>& visit);

// True if the JPEG has a marker of its end, outside its segments: a thumbnail in one of them has its own.
bool has_jpeg_end(std::string_view jpeg);

// The picture as it is to be seen, from one that was stored with this orientation.
CodedImage upright(CodedImage image, int orientation);

}  // namespace eyeray::engine::image
