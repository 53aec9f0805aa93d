#include "host/core/termination.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <memory>
#include <thread>
#include <vector>

#include "host/core/atomic_file.hpp"
#include "host/core/memory_shortage.hpp"
#include "host/core/stopwatch.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

void watch_and_report() {
  watch_for_termination([](const Error& error) { fmt::print(stderr, "ended: {}\n", error.what()); });
}

void sleep_seconds(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

[[noreturn]] void hang() {
  while (true) ::pause();
}

// A process that runs one of the skipped tests below.
class Child : public Process {
 public:
  explicit Child(const std::string& test, const Environment& environment = {})
      : Process({std::filesystem::read_symlink("/proc/self/exe").string(), "--test-case=child: " + test,
                 "--no-skip"},
                environment) {}
  bool says(const std::string& text) { return wait_for_error_text(text, 30); }
  bool ends() { return wait(30); }
};

}  // namespace

TEST_CASE("child: polls" * doctest::skip()) {
  watch_and_report();
  const Saving saving;
  fmt::print(stderr, "ready\n");
  while (!interrupted()) sleep_seconds(0.001);
  std::_Exit(exit_status(ExitCode::interrupted));
}

TEST_CASE("the first signal sets the flag, and determines the exit status") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Child child("polls");
    REQUIRE(child.says("ready"));
    child.send_signal(signal);
    REQUIRE(child.ends());
    CHECK(child.code() == 128 + signal);
    CHECK(child.err().find("ended") == std::string::npos);
  }
}

TEST_CASE("child: ignores SIGHUP" * doctest::skip()) {
  std::signal(SIGHUP, SIG_IGN);
  watch_and_report();
  fmt::print(stderr, "ready\n");
  hang();
}

TEST_CASE("under nohup SIGHUP is ignored") {
  Child child("ignores SIGHUP");
  REQUIRE(child.says("ready"));
  child.send_signal(SIGHUP);
  CHECK_FALSE(child.wait(0.1));
  child.send_signal(SIGTERM);
  REQUIRE(child.ends());
  CHECK(child.code() == 128 + SIGTERM);  // the code of the first signal that was seen
}

TEST_CASE("child: does not poll" * doctest::skip()) {
  watch_and_report();
  AtomicFile file(std::getenv("EYERAY_TEST_FILE"));
  file.write("half of it");
  fmt::print(stderr, "ready\n");
  hang();
}

TEST_CASE("work that does not poll is ended, and its half-written files are removed") {
  const TemporaryFolder folder;
  Child child("does not poll", {{"EYERAY_TEST_FILE", folder / "file"}});
  REQUIRE(child.says("ready"));
  CHECK(folder.names().size() == 1);
  child.send_signal(SIGTERM);
  REQUIRE(child.ends());
  CHECK(child.code() == 128 + SIGTERM);
  CHECK(child.err().find("ended: interrupted\n") != std::string::npos);
  CHECK(folder.names().empty());
}

TEST_CASE("child: has its output full" * doctest::skip()) {
  watch_and_report();
  int ends[2];
  CHECK(::pipe(ends) == 0);
  fmt::print(stderr, "ready\n");
  // Nobody reads: the write below never returns, and holds standard error's lock.
  ::dup2(ends[1], STDERR_FILENO);
  while (true) fmt::print(stderr, "{}\n", std::string(65536, '.'));
}

TEST_CASE("a full output does not delay the end") {
  Child child("has its output full");
  REQUIRE(child.says("ready"));
  child.send_signal(SIGINT);
  REQUIRE(child.ends());
  CHECK(child.code() == 128 + SIGINT);
}

TEST_CASE("child: saves for ever" * doctest::skip()) {
  watch_and_report();
  const Saving saving;
  fmt::print(stderr, "ready\n");
  while (!interrupted()) sleep_seconds(0.001);
  fmt::print(stderr, "seen\n");
  hang();
}

TEST_CASE("one signal lets the process save, two at once count as one, another ends it") {
  Child child("saves for ever");
  REQUIRE(child.says("ready"));
  child.send_signal(SIGTERM);
  child.send_signal(SIGINT);
  REQUIRE(child.says("seen"));
  CHECK_FALSE(child.wait(0.5));
  child.send_signal(SIGINT);
  REQUIRE(child.ends());
  // Either of the two signals may arrive first.
  CHECK((child.code() == 128 + SIGTERM || child.code() == 128 + SIGINT));
  CHECK(child.err().find("ended: interrupted\n") != std::string::npos);
}

TEST_CASE("child: calls a function that never returns" * doctest::skip()) {
  watch_and_report();
  const Saving saving;
  const ForeignCall call(0.05, Error(ExitCode::timed_out, "it took too long"));
  hang();
}

TEST_CASE("a call that does not return is ended, even while work waits to be saved") {
  Child child("calls a function that never returns");
  REQUIRE(child.ends());
  CHECK(child.code() == int(ExitCode::timed_out));
  CHECK(child.err().find("ended: it took too long\n") != std::string::npos);
}

TEST_CASE("child: returns too late and saves" * doctest::skip()) {
  watch_and_report();
  {
    const Saving saving;
    {
      const ForeignCall call(0.05, Error(ExitCode::timed_out, "it took too long"));
      while (!call.passed()) sleep_seconds(0.001);
    }
    sleep_seconds(0.6);  // twice the grace period
    fmt::print(stderr, "saved\n");
  }
  hang();
}

TEST_CASE("a call that returned too late leaves time to save, but not to continue") {
  Child child("returns too late and saves");
  REQUIRE(child.ends());
  CHECK(child.code() == int(ExitCode::timed_out));
  CHECK(child.err().find("saved\nended: it took too long\n") != std::string::npos);
}

TEST_CASE("child: measures" * doctest::skip()) {
  const Stopwatch wall;
  WakefulStopwatch watch;
  fmt::print(stderr, "ready\n");
  while (watch.seconds() < 0.4) sleep_seconds(0.001);
  std::_Exit(wall.seconds() - watch.seconds() > 0.3 ? 7 : 8);
}

TEST_CASE("time in which the process is stopped does not count") {
  Child child("measures");
  REQUIRE(child.says("ready"));
  child.send_signal(SIGSTOP);
  sleep_seconds(0.6);
  child.send_signal(SIGCONT);
  REQUIRE(child.ends());
  CHECK(child.code() == 7);
}

TEST_CASE("child: has no memory in a thread" * doctest::skip()) {
  watch_and_report();
  report_memory_shortage();
  std::thread([] { throw std::bad_alloc(); }).join();
}

TEST_CASE("child: breaks off" * doctest::skip()) {
  watch_and_report();
  report_memory_shortage();
  if (std::getenv("EYERAY_TEST_LIMIT")) {
    const rlimit limit{1 << 20, RLIM_INFINITY};  // less memory than it has
    CHECK(::setrlimit(RLIMIT_AS, &limit) == 0);
  }
  std::abort();
}

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer);
#else
constexpr bool sanitized = false;
#endif

TEST_CASE("memory that runs out in a library gives a message, but any other crash stays a crash") {
  std::vector<std::unique_ptr<Child>> children;
  children.push_back(std::make_unique<Child>("has no memory in a thread"));
  // AddressSanitizer itself needs more memory than that.
  if (!sanitized)
    children.push_back(std::make_unique<Child>("breaks off", Environment{{"EYERAY_TEST_LIMIT", "1"}}));
  for (const std::unique_ptr<Child>& child : children) {
    REQUIRE(child->ends());
    CHECK(child->code() == int(ExitCode::no_device));
    CHECK(child->err().find("ut of memory") != std::string::npos);
  }
  Child crash("breaks off");
  REQUIRE(crash.ends());
  CHECK(crash.code() == 128 + SIGABRT);
}
