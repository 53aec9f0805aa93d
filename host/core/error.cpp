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
  std::signal(SIGABRT, SIG_DFL);  // a failed check is a bug, not a shortage of memory
  std::abort();
}

}  // namespace eyeray::engine
