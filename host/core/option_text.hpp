// Names of options in messages, as the reader of the message writes them: on the command line or in the
// library.
#pragma once

#include <string>
#include <string_view>

namespace eyeray::engine {

// "timeout" is "--timeout" on the command line, and "`timeout`" for callers of the library. Safe from any
// thread.
std::string option_text(std::string_view name);
// With its value: "--backend twin", "`backend` twin".
std::string option_text(std::string_view name, std::string_view value);

// While one is alive the command has an option `backends`, and messages name that for "backend". One at a
// time.
class OptionBackends {
 public:
  OptionBackends();
  ~OptionBackends();
  OptionBackends(const OptionBackends&) = delete;
  OptionBackends& operator=(const OptionBackends&) = delete;
};

// From now on messages name options as callers of the library write them.
void speak_to_library();

}  // namespace eyeray::engine
