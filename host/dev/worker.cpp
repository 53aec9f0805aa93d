#include "host/dev/worker.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <utility>

#include "host/core/error.hpp"
#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"

namespace eyeray::dev {
namespace {

constexpr double longest_farewell = 2;  // seconds

// Whether the whole text went out; a reader that is gone is an answer, not a signal.
bool send_all(int socket, const std::string& text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t count = ::send(socket, text.data() + done, text.size() - done, MSG_NOSIGNAL);
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) done += size_t(count);
  }
  return true;
}

// The child: a line in, a line out, until the parent closes its end.
[[noreturn]] void serve_forever(int socket, const Worker::Serve& serve) {
  std::string pending;
  char buffer[4096];
  for (ssize_t count; (count = ::read(socket, buffer, sizeof buffer)) > 0;) {
    pending.append(buffer, size_t(count));
    for (size_t end; (end = pending.find('\n')) != std::string::npos; pending.erase(0, end + 1)) {
      const std::string answer = serve(pending.substr(0, end));
      std::fflush(nullptr);
      if (!send_all(socket, answer + '\n')) _exit(1);
    }
  }
  // Not exit(): what the parent registered to run at its end is the parent's.
  _exit(0);
}

}  // namespace

void Worker::start() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw Error(ExitCode::file_io, "cannot talk to a worker process: socketpair: {}", strerror(errno));
  std::fflush(nullptr);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    // The parent ends its child, with a watch of its own so that no file stays half written. Ctrl-C in a
    // terminal reaches both, and is the parent's business.
    watch_for_termination([](const Error&) {});
    for (const int number : {SIGINT, SIGHUP}) std::signal(number, SIG_IGN);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);
    ::close(ends[0]);
    serve_forever(ends[1], serve_);
  }
  ::close(ends[1]);
  socket_ = ends[0];
  if (pid_ < 0) {
    ::close(std::exchange(socket_, -1));
    throw Error(ExitCode::file_io, "cannot start a worker process: fork: {}", strerror(errno));
  }
}

void Worker::kill() {
  if (pid_ < 0) return;
  // One that is idle ends by itself, and any other at a signal: it should not come to the second.
  ::shutdown(socket_, SHUT_RDWR);
  ::kill(pid_, SIGTERM);
  const Stopwatch watch;
  while (!has_ended() && watch.seconds() < longest_farewell) ::usleep(1000);
  ::kill(pid_, SIGKILL);
  bury();
}

bool Worker::has_ended() const {
  siginfo_t info{};
  return waitid(P_PID, id_t(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid_;
}

// Waits for the child's end and tells how it came.
Worker::Answer Worker::bury() {
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  ::close(std::exchange(socket_, -1));
  pid_ = -1;
  if (!WIFSIGNALED(status)) return {Outcome::died, fmt::format("exit code {}", WEXITSTATUS(status))};
  return {Outcome::died, fmt::format("signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)))};
}

Worker::Answer Worker::ask(const std::string& request, double timeout_seconds) {
  if (pid_ >= 0 && has_ended()) bury();  // in its sleep: not this request's doing
  if (pid_ < 0) start();
  if (!send_all(socket_, request + '\n')) return bury();

  // Read a line, looking at the clock and at Ctrl-C now and then.
  WakefulStopwatch watch;
  std::string line;
  while (true) {
    pollfd polled{socket_, POLLIN, 0};
    const double left = timeout_seconds - watch.seconds();
    const int ready = ::poll(&polled, 1, int(std::clamp(left, 0.0, 0.1) * 1000) + 1);
    if (ready > 0) {
      char buffer[4096];
      const ssize_t count = ::read(socket_, buffer, sizeof buffer);
      if (count == 0) return bury();
      if (count > 0) line.append(buffer, size_t(count));
      if (line.ends_with('\n')) {
        line.pop_back();
        return {Outcome::answered, line};
      }
    }
    if (interrupted()) {
      kill();
      return {Outcome::interrupted, ""};
    }
    if (watch.seconds() >= timeout_seconds) {
      kill();
      return {Outcome::timed_out, ""};
    }
  }
}

}  // namespace eyeray::dev
