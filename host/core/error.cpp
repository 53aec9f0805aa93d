#include "core/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace eyeray::detail {

void check_failed(const char* file, int line, const char* expression, const std::string& values) {
  fmt::print(stderr,
             "{}:{}: check failed: {}{}\nThis is a bug in eyeray; please report it with the command line.\n",
             file, line, expression, values);
  std::abort();
}

}  // namespace eyeray::detail
