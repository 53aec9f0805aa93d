// Pictures on disk. The format follows the file name's ending.
//   .png  8-bit sRGB, the true curve, round half up; clipped to [0, 1]; NaN and negatives become 0; with 4
//         channels colours are not multiplied by alpha
//   .pfm  float32, linear, unclipped, 1 or 3 channels, little-endian
//   .hdr  Radiance RGBE, linear; NaN and negatives become 0
//   .exr  OpenEXR, float32, linear, unclipped, in layers (image/exr_file.hpp); with 4 channels colours are
//         multiplied by alpha
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/core/atomic_file.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine::image {

enum class ImageFormat { png, pfm, hdr, exr };

// The format for a file name's ending. Error (bad_input), with a list of the known endings, for another
// ending.
ImageFormat image_format(const std::filesystem::path& path);

// True if a picture may be this large: 1 … 65536 pixels each way, 2^28 in all.
bool image_size_allowed(int64_t width, int64_t height);

// Throws Error (bad_input) if files of the name's format have no alpha.
void check_has_alpha(const std::filesystem::path& path);

// Writes an image of 1 or 3 channels atomically, or one of 4 to a .png or .exr. Error (bad_input) for another
// format of 4.
void write_image(const std::filesystem::path& path, const Image& image);

// The bytes of a .png of the image.
std::string encode_png(const Image& image);

// Reads a picture as linear float32 (a PNG through the inverse sRGB curve); `layer` is that of an .exr. Sizes
// up to 65536 × 65536 and 2^28 pixels; Error (file_io) for anything unreadable or malformed. `warnings` gets
// a sentence for each ignored field of the header that changes the meaning of the numbers.
Image read_image(const std::filesystem::path& path, const std::string& layer,
                 std::vector<std::string>& warnings);
Image read_image(const std::filesystem::path& path, const std::string& layer = "");

// The alpha of a .png or .exr, 1 channel; empty if the file has none.
std::optional<Image> read_alpha(const std::filesystem::path& path);

// Linear [0, 1] to an 8-bit sRGB code (IEC 61966-2-1), round half up.
unsigned char srgb8(float linear);
// An alpha to an 8-bit code, round half up; NaN becomes 0.
unsigned char alpha8(float alpha);

}  // namespace eyeray::engine::image
