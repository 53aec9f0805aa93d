// A worker that answers, dies, hangs, and starts anew.
#include "host/dev/worker.hpp"

#include <unistd.h>

#include <csignal>

#include "host/core/atomic_file.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::dev;
using Outcome = Worker::Outcome;

namespace {

std::string obey(const std::string& request) {
  static int served = 0;
  ++served;
  if (request == "hang") pause();
  if (request == "crash") {
    std::signal(SIGABRT, SIG_DFL);  // doctest's handler would speak for the child
    raise(SIGABRT);
  }
  if (request == "exit") _exit(7);
  if (request == "pid") return std::to_string(getpid());
  if (request == "count") return std::to_string(served);
  if (request == "long") return std::string(1 << 20, 'x');
  return request;
}

}  // namespace

TEST_CASE("one process answers request after request") {
  Worker worker(obey);
  const Worker::Answer pid = worker.ask("pid", 600);
  REQUIRE(pid.outcome == Outcome::answered);
  CHECK(pid.text != std::to_string(getpid()));
  CHECK(worker.ask("hello", 600).text == "hello");
  CHECK(worker.ask("", 600).text == "");
  CHECK(worker.ask("long", 600).text == std::string(1 << 20, 'x'));
  CHECK(worker.ask("pid", 600).text == pid.text);
  CHECK(worker.ask("count", 600).text == "6");
}

TEST_CASE("a worker that dies is told apart by how, and the next one starts fresh") {
  Worker worker(obey);
  CHECK(worker.ask("hello", 600).outcome == Outcome::answered);
  const Worker::Answer crash = worker.ask("crash", 600);
  CHECK(crash.outcome == Outcome::died);
  CHECK(crash.text == "signal 6 (Aborted)");
  const Worker::Answer exit = worker.ask("exit", 600);
  CHECK(exit.outcome == Outcome::died);
  CHECK(exit.text == "exit code 7");
  CHECK(worker.ask("count", 600).text == "1");
}

TEST_CASE("a worker that died between requests is replaced") {
  Worker worker(obey);
  const pid_t pid = std::stoi(worker.ask("pid", 600).text);
  kill(pid, SIGKILL);
  test::wait_until_ended(pid);
  CHECK(worker.ask("count", 600).text == "1");
  CHECK(worker.ask("pid", 600).text != std::to_string(pid));
}

TEST_CASE("a worker that hangs is killed in time") {
  Worker worker(obey);
  const pid_t pid = std::stoi(worker.ask("pid", 600).text);
  const Stopwatch watch;
  CHECK(worker.ask("hang", 0.2).outcome == Outcome::timed_out);
  CHECK(watch.seconds() >= 0.2);
  CHECK(kill(pid, 0) != 0);
  CHECK(worker.ask("hello", 600).text == "hello");
}

TEST_CASE("a worker that is killed leaves nothing half written") {
  const test::TemporaryFolder folder;
  Worker worker([&](const std::string&) {
    const AtomicFile file(folder / "file");
    while (true) pause();
    return std::string();
  });
  CHECK(worker.ask("write", 0.2).outcome == Outcome::timed_out);
  CHECK(folder.names().empty());
}

TEST_CASE("a worker ends with its owner") {
  pid_t pid = 0;
  {
    Worker worker(obey);
    pid = std::stoi(worker.ask("pid", 600).text);
    CHECK(kill(pid, 0) == 0);
  }
  CHECK(kill(pid, 0) != 0);
}
