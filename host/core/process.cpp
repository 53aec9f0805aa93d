#include "host/core/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "host/core/error.hpp"

namespace eyeray::engine {
namespace {

// The caller's environment with `changes` laid over it, as NAME=VALUE.
std::vector<std::string> merged_environment(const Environment& changes) {
  std::vector<std::string> merged;
  for (char** entry = environ; *entry; ++entry) {
    const std::string_view text = *entry;
    const std::string_view name = text.substr(0, text.find('='));
    const auto changed = [&](const auto& change) { return change.first == name; };
    if (std::none_of(changes.begin(), changes.end(), changed)) merged.emplace_back(text);
  }
  for (const auto& [name, value] : changes) merged.push_back(name + "=" + value);
  return merged;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

struct Pipe {
  int read = -1;
  int write = -1;
  Pipe() {
    int fds[2];
    if (pipe2(fds, O_CLOEXEC) != 0) throw Error(ExitCode::file_io, "cannot make a pipe: {}", strerror(errno));
    read = fds[0];
    write = fds[1];
  }
};

// Appends the readable bytes; closes at the end of the stream.
void drain(int& fd, std::string& text) {
  char buffer[65536];
  const ssize_t count = ::read(fd, buffer, sizeof buffer);
  if (count > 0) {
    text.append(buffer, size_t(count));
  } else if (count == 0 || errno != EINTR) {
    ::close(fd);
    fd = -1;
  }
}

}  // namespace

Process::Process(const std::vector<std::string>& argv, const Environment& environment) {
  Pipe out, err;
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, out.write, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, err.write, STDERR_FILENO);

  // Signals that this process ignores are not ignored by its children.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults;
  sigemptyset(&defaults);
  for (const int number : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM}) sigaddset(&defaults, number);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);

  std::vector<std::string> arguments = argv;
  std::vector<std::string> variables = merged_environment(environment);
  const int failure = posix_spawnp(&pid_, argv.at(0).c_str(), &files, &attributes, pointers(arguments).data(),
                                   pointers(variables).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  ::close(out.write);
  ::close(err.write);
  out_fd_ = out.read;
  err_fd_ = err.read;
  if (failure != 0) {
    ::close(out_fd_);
    ::close(err_fd_);
    throw Error(ExitCode::file_io, "cannot start {}: {}", argv.at(0), strerror(failure));
  }
}

Process::~Process() {
  if (!code_) {
    ::kill(pid_, SIGKILL);
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  if (out_fd_ >= 0) ::close(out_fd_);
  if (err_fd_ >= 0) ::close(err_fd_);
}

void Process::send_signal(int number) {
  if (!code_) ::kill(pid_, number);
}

// Takes in the output that arrives within `seconds`; false when none did.
bool Process::receive(double seconds) {
  pollfd polled[2] = {{out_fd_, POLLIN, 0},
                      {err_fd_, POLLIN, 0}};  // a closed one is −1, which poll passes over
  if (::poll(polled, 2, int(seconds * 1000)) <= 0) return false;
  if (polled[0].revents) drain(out_fd_, out_);
  if (polled[1].revents) drain(err_fd_, err_);
  return true;
}

// Takes in the output that arrives within `seconds`, or notices the end.
void Process::listen(double seconds) {
  // With both streams closed only the end is left to wait for, and nothing announces it.
  const bool open = out_fd_ >= 0 || err_fd_ >= 0;
  if (receive(std::clamp(seconds, 0.001, open ? 0.05 : 0.001))) return;
  int status = 0;
  rusage used{};
  if (wait4(pid_, &status, WNOHANG, &used) != pid_) return;
  for (const timeval& time : {used.ru_utime, used.ru_stime})
    processor_seconds_ += double(time.tv_sec) + double(time.tv_usec) * 1e-6;
  page_faults_ = used.ru_minflt;
  code_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  while (receive(0)) {
  }
}

bool Process::wait(double seconds) {
  const Stopwatch watch;
  while (!code_ && watch.seconds() < seconds) listen(seconds - watch.seconds());
  return code_.has_value();
}

bool Process::wait_for_error_text(const std::string& text, double seconds, size_t from) {
  const Stopwatch watch;
  while (err_.find(text, from) == std::string::npos) {
    if (code_ || watch.seconds() >= seconds) return false;
    listen(seconds - watch.seconds());
  }
  return true;
}

std::vector<std::string> own_command() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  words.at(0) = "/proc/self/exe";
  return words;
}

void restart(const Environment& environment) {
  std::vector<std::string> arguments = own_command();
  std::vector<std::string> variables = merged_environment(environment);
  // Name the program by its own path, which debuggers look for.
  arguments[0] = std::filesystem::read_symlink("/proc/self/exe");
  ::execve("/proc/self/exe", pointers(arguments).data(), pointers(variables).data());
  throw Error(ExitCode::file_io, "cannot restart {}: {}", arguments[0], strerror(errno));
}

ProcessResult run_process(const std::vector<std::string>& argv, const Environment& environment,
                          double timeout_seconds, int signal_after_ms) {
  const Stopwatch watch;
  Process process(argv, environment);
  if (signal_after_ms >= 0 && !process.wait(signal_after_ms / 1000.0)) process.send_signal(SIGINT);
  process.wait(timeout_seconds);
  return {process.code().value_or(-1), process.out(),        process.err(), watch.seconds(),
          process.processor_seconds(), process.page_faults()};
}

}  // namespace eyeray::engine
