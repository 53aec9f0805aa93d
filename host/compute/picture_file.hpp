// Pictures as the contents of buffers and images. A pixel is a float, a vec3 or a vec4 of linear colour, or a
// uint or four bytes of 8-bit codes with red in the lowest byte.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "host/compute/type.hpp"

namespace eyeray::engine::compute {

// True if the file's ending is that of a picture.
bool is_picture(const std::filesystem::path& file);

// Throws Error (bad_input) if a picture of that width cannot hold the block.
void check_picture(const std::filesystem::path& file, const Type& block, uint64_t width);

// As read_block and write_block of data_file.hpp.
std::vector<std::byte> read_picture(const std::filesystem::path& file, TypePtr& block);
void write_picture(const std::filesystem::path& file, const Type& block, std::span<const std::byte> bytes,
                   uint64_t width);

}  // namespace eyeray::engine::compute
