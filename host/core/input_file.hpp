// A file that a person names, read whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace eyeray::engine {

// The bytes of a regular file of at most `most_bytes`. Error (file_io): "cannot read the scene a.toml:
// reason" where `what` is "the scene". If there is no such file, it suggests a name in the same folder that
// the user may have meant.
std::string read_input_file(const std::filesystem::path& file, std::string_view what, size_t most_bytes);

// Removes the byte order mark that some editors put before text in UTF-8.
void drop_byte_order_mark(std::string& text);

}  // namespace eyeray::engine
