#include "host/core/standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <initializer_list>
#include <string>

#include "host/core/github_text.hpp"

namespace eyeray::engine {
namespace {

// Writes as much as can be written. Returns 0 if all was, else the reason as errno has it.
int write_all(int file, const char* bytes, size_t size) {
  while (size > 0) {
    const ssize_t count = ::write(file, bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    bytes += count;
    size -= size_t(count);
  }
  return 0;
}

ssize_t write_words(void*, const char* bytes, size_t size) {
  write_all(STDERR_FILENO, bytes, size);
  return ssize_t(size);
}

ssize_t write_data(void*, const char* bytes, size_t size) {
  const int failure = write_all(STDOUT_FILENO, bytes, size);
  if (failure == 0 || failure == EPIPE) return ssize_t(size);
  errno = failure;
  return 0;
}

// glibc lets its three streams be replaced. Without memory for a new stream, the old one stays.
void replace(FILE*& stream, cookie_write_function_t* write, int buffering) {
  cookie_io_functions_t functions{};
  functions.write = write;
  FILE* const safe = ::fopencookie(nullptr, "w", functions);
  if (!safe) return;
  std::setvbuf(safe, nullptr, buffering, BUFSIZ);
  stream = safe;
}

}  // namespace

void make_standard_streams_safe() {
  // A closed stream still fails when used: its stand-in is open for the other direction.
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(file, F_GETFD) < 0) ::open("/dev/null", file == STDOUT_FILENO ? O_RDONLY : O_WRONLY);
  }
  for (const int number : {SIGPIPE, SIGXFSZ}) std::signal(number, SIG_IGN);
  replace(stderr, write_words, _IONBF);
  replace(stdout, write_data, ::isatty(STDOUT_FILENO) ? _IOLBF : _IOFBF);
}

void print_text(std::FILE* stream, std::string_view text) {
  const std::string lines = log_lines(text);
  std::fwrite(lines.data(), 1, lines.size(), stream);
}

}  // namespace eyeray::engine
