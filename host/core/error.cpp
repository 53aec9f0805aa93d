#include "host/core/error.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace eyeray::detail {

void check_failed(const char* file, int line, const char* expression, const std::string& values) {
  fmt::print(stderr,
             "{}:{}: check failed: {}{}\nThis is a bug in eyeray; please report it with the command line.\n",
             file, line, expression, values);
  std::signal(SIGABRT, SIG_DFL);  // whatever memory is left, this is a bug
  std::abort();
}

}  // namespace eyeray::detail
