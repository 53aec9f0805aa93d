#pragma once

#include <string>
#include <string_view>

namespace eyeray {

// Of any bytes, what a command of GitHub's workflows can hold ("::error file=…::…"): a property's end at ,
// and : too.
std::string github_text(std::string_view text, bool property);

}  // namespace eyeray
