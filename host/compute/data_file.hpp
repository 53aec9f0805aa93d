// The files that buffers are read from and written to, by their endings: .npy, .bin, pictures, and .csv,
// which is written only (docs/kernel-files.md).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/compute/type.hpp"

namespace eyeray::engine::compute {

// Throws Error (bad_input) if no file of that name can hold a value of the type.
void check_output(const std::filesystem::path& file, const Type& block, uint64_t width);

// True if the file, a picture or a .npy, decides the extent of an image that has none yet.
bool decides_extent(const std::filesystem::path& file, const Type& image);

// Reads a block. A run-time array gets as many elements as the file has; a block of another size must have
// just as many. So does an image without an extent. Returns the sized block's bytes, and sets `block` to its
// type. Error (file_io) if the file cannot be read, (bad_input) if it has other numbers than the block.
std::vector<std::byte> read_block(const std::filesystem::path& file, TypePtr& block);

// Writes a block. `width`: that of a picture, in pixels.
void write_block(const std::filesystem::path& file, const Type& block, std::span<const std::byte> bytes,
                 uint64_t width);

}  // namespace eyeray::engine::compute
