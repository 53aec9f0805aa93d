#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string_view>
#include <utility>

namespace eyeray::engine {

// Makes the standard streams safe to rely on, however the program was started; to be called first.
//
// Text that standard error does not take is lost, which is never an error: it may be closed, a full disk, or
// a pipe whose reader has gone. A pipe on standard output may lose its reader too, who wanted no more. Any
// other failure of standard output is an error, which ferror(stdout) shows. No write raises SIGPIPE or
// SIGXFSZ. If descriptor 0, 1 or 2 is closed, a stand-in is opened, so that no other file gets its number.
void make_standard_streams_safe();

// Prints text for people, each line as log_line() returns it: a name in it may come from a file.
void print_text(std::FILE* stream, std::string_view text);

template <typename... Args>
void print_lines(std::FILE* stream, fmt::format_string<Args...> format, Args&&... args) {
  print_text(stream, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace eyeray::engine
