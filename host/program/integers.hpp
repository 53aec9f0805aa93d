// Values of options that are made of whole numbers.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace eyeray::engine::program {

// Reads whole numbers with a separator between them, as many as `numbers` holds. False if `text` has another
// form.
bool parse_integers(std::string_view text, char separator, std::span<int> numbers);

// "640x480" as {640, 480}; Error (bad_input) for anything else.
std::pair<int, int> parse_size(const std::string& text);

}  // namespace eyeray::engine::program
