#include "host/core/error.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace eyeray::engine {

namespace {
constexpr const char* please_report = "This is a bug in eyeray; please report it with the command line.";
}

Error own_fault(const std::string& what) {
  return {ExitCode::internal, "internal error: {}\n{}", what, please_report};
}

void detail::check_failed(const char* file, int line, const char* expression, const std::string& values) {
  fmt::print(stderr, "{}:{}: check failed: {}{}\n{}\n", file, line, expression, values, please_report);
  std::signal(SIGABRT, SIG_DFL);  // with any memory left or none, this is a bug
  std::abort();
}

}  // namespace eyeray::engine
