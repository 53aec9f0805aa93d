#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string_view>
#include <utility>

namespace eyeray::engine {

// Makes the standard streams safe to rely on, however the program was started; to be called first.
//
// Words that standard error does not take are lost, which is never a fault: it may be closed, a full disk, or
// a pipe whose reader has gone. A pipe on standard output may lose its reader as well, who wanted no more;
// any other failure there is one, to be seen by ferror(stdout). No write raises SIGPIPE or SIGXFSZ. Where 0,
// 1 or 2 is closed something stands in for it, so that no file gets its number.
void make_standard_streams_safe();

// Prints text for people, each line of it as log_line() has it: a name in it may come from a file.
void print_text(std::FILE* stream, std::string_view text);

template <typename... Args>
void print_lines(std::FILE* stream, fmt::format_string<Args...> format, Args&&... args) {
  print_text(stream, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace eyeray::engine
