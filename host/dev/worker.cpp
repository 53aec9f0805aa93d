#include "host/dev/worker.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <utility>

#include "host/core/error.hpp"
#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"

namespace eyeray::engine::dev {
namespace {

constexpr double longest_farewell = 2;  // seconds

}  // namespace

void Worker::start() {
  kill();
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw Error(ExitCode::file_io, "cannot talk to a worker process: socketpair: {}", strerror(errno));
  socket_ = MessageSocket(ends[0]);
  // Between fork and exec the child makes only calls that are safe in a program with other threads.
  const std::string descriptor = std::to_string(ends[1]);
  std::vector<char*> arguments;
  for (std::string& word : command_) arguments.push_back(word.data());
  arguments.push_back(const_cast<char*>(descriptor.c_str()));
  arguments.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    ::fcntl(ends[1], F_SETFD, 0);
    ::execv(arguments[0], arguments.data());
    _exit(127);
  }
  ::close(ends[1]);
  if (pid_ < 0) {
    socket_.close();
    throw Error(ExitCode::file_io, "cannot start a worker process: fork: {}", strerror(errno));
  }
}

std::string Worker::kill() {
  if (!running()) return "";
  // An idle worker ends once its socket is closed, any other at SIGTERM. SIGKILL should not be needed.
  ::shutdown(socket_.descriptor(), SHUT_RDWR);
  const Stopwatch watch;
  bool requested = false;
  while (!has_ended() && watch.seconds() < longest_farewell) {
    if (!requested && watch.seconds() > 0.05) requested = ::kill(pid_, SIGTERM) == 0;
    ::usleep(1000);
  }
  ::kill(pid_, SIGKILL);
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  socket_.close();
  pid_ = -1;
  if (!WIFSIGNALED(status)) return fmt::format("exit code {}", WEXITSTATUS(status));
  return fmt::format("signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
}

bool Worker::debugged() const {
  std::ifstream status(fmt::format("/proc/{}/status", pid_));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("TracerPid:")) return line.find_first_of("123456789") != std::string::npos;
  return false;
}

bool Worker::has_ended() const {
  siginfo_t info{};
  return waitid(P_PID, id_t(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid_;
}

void be_a_worker() {
  // Ctrl-C in a terminal reaches both processes; the supervisor handles it.
  for (const int number : {SIGINT, SIGHUP}) std::signal(number, SIG_IGN);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  prctl(PR_SET_NAME, "eyeray-worker");
  end_silently();
}

}  // namespace eyeray::engine::dev
