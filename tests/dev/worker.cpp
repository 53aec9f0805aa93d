// A worker that answers, dies, hangs, and starts anew; and malformed messages.
#include "host/dev/worker.hpp"

#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>

#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine::dev;
using eyeray::engine::test::wait_until_ended;

namespace {

// A shell that is given the descriptor of its socket as $1.
std::vector<std::string> shell(const std::string& script) {
  return {"/bin/bash", "-c", script, "bash"};
}
const std::string echo = "exec cat <&$1 >&$1";

int open_descriptors() {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) count += entry.exists();
  return count;
}

MessageSocket socket_with(const std::string& bytes) {
  int ends[2];
  REQUIRE(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0);
  REQUIRE(::write(ends[1], bytes.data(), bytes.size()) == ssize_t(bytes.size()));
  ::close(ends[1]);
  return MessageSocket(ends[0]);
}

}  // namespace

TEST_CASE("messages go to a worker and back whole") {
  Worker worker(shell(echo));
  worker.start();
  const std::string bytes(60'000, '\x07');
  REQUIRE(worker.socket().send({{{"a", 1}}, ""}));
  const auto first = worker.socket().receive(600);
  REQUIRE(first);
  CHECK(first->json == Json{{"a", 1}});
  CHECK(first->bytes.empty());
  // Larger than a pipe holds: the other end takes it while it is sent.
  REQUIRE(worker.socket().send({{{"name", "b\n\"c"}}, bytes}));
  REQUIRE(worker.socket().send({{{"last", true}}, "x"}));
  const auto second = worker.socket().receive(600);
  REQUIRE(second);
  CHECK(second->json.at("name") == "b\n\"c");
  CHECK(second->bytes == bytes);
  CHECK(worker.socket().receive(600)->bytes == "x");
  CHECK_FALSE(worker.socket().receive(0));
  CHECK_FALSE(worker.socket().closed());
  CHECK(worker.kill() == "exit code 0");
}

TEST_CASE("the way in which a worker ended is reported") {
  for (const auto& [script, how] :
       {std::pair{"kill -ABRT $$", "signal 6 (Aborted)"}, {"exit 7", "exit code 7"}}) {
    Worker worker(shell(script));
    worker.start();
    CHECK_FALSE(worker.socket().receive(600));
    CHECK(worker.socket().closed());
    CHECK(worker.kill() == how);
    CHECK_FALSE(worker.running());
  }
  Worker nothing({"/nonexistent/program"});
  nothing.start();
  CHECK_FALSE(nothing.socket().receive(600));
  CHECK(nothing.kill() == "exit code 127");
}

TEST_CASE("a worker that ignores signals is ended too") {
  Worker deaf(shell("trap '' TERM; echo >&$1; while :; do sleep 1; done"));
  deaf.start();
  CHECK_FALSE(deaf.socket().receive(0.2));
  CHECK(deaf.kill() == "signal 9 (Killed)");
  Worker sleeper(shell("exec sleep 1000"));
  sleeper.start();
  CHECK(sleeper.kill() == "signal 15 (Terminated)");
}

TEST_CASE("a hundred workers leave nothing behind") {
  Worker worker(shell("exit 0"));
  const int before = open_descriptors();
  for (int i = 0; i < 100; ++i) worker.start();
  worker.kill();
  CHECK(open_descriptors() == before);
}

TEST_CASE("bytes that are no message close the socket") {
  const std::string huge("\xff\xff\xff\xff\x00\x00\x00\x00{}", 10),
      text("\x02\x00\x00\x00\x00\x00\x00\x00[]", 10), torn("\x08\x00\x00\x00\x00\x00\x00\x00{}", 10), none;
  for (const std::string& bytes : {huge, text, torn, none}) {
    MessageSocket socket = socket_with(bytes);
    CHECK_FALSE(socket.receive(600));
    CHECK(socket.closed());
    CHECK_FALSE(socket.send({Json::object(), ""}));
  }
}

TEST_CASE("a worker held by a debugger is detected") {
  Worker worker(shell("exec sleep 600"));
  CHECK_FALSE(worker.debugged());
  worker.start();
  CHECK_FALSE(worker.debugged());
  const pid_t pid = std::stoi(eyeray::engine::test::read_text("/proc/thread-self/children"));
  REQUIRE(ptrace(PTRACE_SEIZE, pid, 0, 0) == 0);
  CHECK(worker.debugged());
  ::kill(pid, SIGKILL);
  CHECK(worker.kill() == "signal 9 (Killed)");
}
