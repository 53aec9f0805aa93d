// JSON as text, before a tree is made of it. Private to the importers.
#pragma once

#include <string>
#include <string_view>

namespace eyeray::engine::importers {

// InputError, with the position, where the text has more brackets in each other or more values than a tree of
// it should. Also for one key twice in an object: readers differ in which of them counts. Takes time that
// grows with the length. Text that is no JSON may pass.
void check_json_text(std::string_view text, const std::string& file);

}  // namespace eyeray::engine::importers
