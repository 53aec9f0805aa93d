// Faults of the world (file, device, shader, memory) are thrown as Error; broken promises inside the
// program end it through CHECK. Nothing else is thrown across a layer.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace eyeray::engine {

// The exit codes of the process. docs/command-line.md lists the same numbers.
enum class ExitCode : int {
  ok = 0,
  comparison_failed = 1,
  bad_input = 2,  // usage, scene or shader
  no_device = 3,  // no usable Vulkan device, or it was lost
  file_io = 4,
  timed_out = 5,
  cannot_resume = 6,  // no render can resume from this checkpoint: it has to begin anew
  internal = 70,      // a fault of eyeray's own (sysexits' EX_SOFTWARE)
  interrupted = 130,
};

// A fault with the exit code it leads to. `what()` is one sentence: the failure, the reason, what to do.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

  template <typename... Args>
  Error(ExitCode code, fmt::format_string<Args...> format, Args&&... args)
      : Error(code, fmt::format(format, std::forward<Args>(args)...)) {}

  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// Error (internal) for a fault of eyeray itself, with the request to report it, since no user can mend it.
Error own_fault(const std::string& what);

// Returns the result of work(), which reads no user input: a bad_input error from it is a fault of eyeray
// itself.
template <typename Work>
auto of_own_input(const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.code() == ExitCode::bad_input) throw own_fault(error.what());
    throw;
  }
}

namespace detail {
[[noreturn]] void check_failed(const char* file, int line, const char* expression, const std::string& values);
}

// Ends the program, and prints both values, when a promise inside it is broken. Active in every build.
#define CHECK(condition) \
  ((condition) ? void() : ::eyeray::engine::detail::check_failed(__FILE__, __LINE__, #condition, ""))
#define CHECK_OP_(a, b, op)                                                                        \
  do {                                                                                             \
    const auto& check_a_ = (a);                                                                    \
    const auto& check_b_ = (b);                                                                    \
    if (!(check_a_ op check_b_))                                                                   \
      ::eyeray::engine::detail::check_failed(__FILE__, __LINE__, #a " " #op " " #b,                \
                                             fmt::format(" ({} against {})", check_a_, check_b_)); \
  } while (false)
#define CHECK_EQ(a, b) CHECK_OP_(a, b, ==)
#define CHECK_LT(a, b) CHECK_OP_(a, b, <)
#define CHECK_LE(a, b) CHECK_OP_(a, b, <=)

}  // namespace eyeray::engine
