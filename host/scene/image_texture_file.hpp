// Image textures from PNG, JPEG, BMP and TGA files, and from such bytes as model files embed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "host/image/coded_image.hpp"
#include "host/scene/image_texture.hpp"

namespace eyeray::engine {

// Error (file_io), as below, where there is no regular file of at most 1 GiB.
void check_image_file(const std::filesystem::path& path);

// The picture in a regular file of at most 1 GiB and 16384 pixels a side, named after the path; filter, wrap
// and colour space are an ImageTexture's defaults. `warnings` as decode_coded_image has them. Error
// (file_io), one sentence with the path and the reason, where it cannot be read or the budget has fewer
// pixels left.
ImageTexture load_image_texture(const std::filesystem::path& path, image::PixelBudget& budget,
                                std::vector<std::string>& warnings);

// Decodes an image from memory. `name` stands in messages.
ImageTexture decode_image_texture(std::span<const std::byte> bytes, const std::string& name,
                                  image::PixelBudget& budget, std::vector<std::string>& warnings);

}  // namespace eyeray::engine
