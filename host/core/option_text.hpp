// Names of options in messages, as whoever reads them gives them: the command line's or the library's.
#pragma once

#include <string>
#include <string_view>

namespace eyeray::engine {

// "timeout" is "--timeout" on the command line, and "`timeout`" for callers of the library, from any thread.
std::string option_text(std::string_view name);
// With its value: "--backend twin", "`backend` twin".
std::string option_text(std::string_view name, std::string_view value);

// From now on the library's callers read this process's messages.
void speak_to_library();

}  // namespace eyeray::engine
