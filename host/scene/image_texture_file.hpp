// Image textures from PNG, JPEG, WebP, TIFF, BMP and TGA files, and from such images within model files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "host/image/coded_image.hpp"
#include "host/scene/image_texture.hpp"

namespace eyeray::engine {

// Error (file_io) unless `path` is a regular file of at most 1 GiB: one sentence with the path and the
// reason.
void check_image_file(const std::filesystem::path& path);

// The picture in a regular file of at most 1 GiB and 16384 pixels a side, named after the path; filter, wrap
// and colour space are an ImageTexture's defaults. `warnings`: as in decode_coded_image. Error (file_io), one
// sentence with the path and the reason, if the file cannot be read or exceeds the pixels left in the budget.
ImageTexture load_image_texture(const std::filesystem::path& path, image::PixelBudget& budget,
                                std::vector<std::string>& warnings);

// Decodes an image from memory. `name` stands in messages.
ImageTexture decode_image_texture(std::span<const std::byte> bytes, const std::string& name,
                                  image::PixelBudget& budget, std::vector<std::string>& warnings);

}  // namespace eyeray::engine
