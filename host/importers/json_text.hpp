// Checks JSON as text, before a tree is made of it. Private to the importers.
#pragma once

#include <string>
#include <string_view>

namespace eyeray::engine::importers {

// InputError, with the position, if the text has too many nested brackets, or too many values for a tree.
// Also if an object has a key twice: readers differ in which of the two counts. The time is linear in the
// length. Text that is no JSON may pass.
void check_json_text(std::string_view text, const std::string& file);

}  // namespace eyeray::engine::importers
