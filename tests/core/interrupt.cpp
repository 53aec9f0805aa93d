#include "core/interrupt.hpp"

#include <csignal>
#include <thread>

#include "support/process.hpp"
//
#include "support/doctest.hpp"

using namespace eyeray;

// The process below: waits for a signal, answers 7 when it has seen one, and with a second one goes on
// waiting.
TEST_CASE("wait for signals" * doctest::skip()) {
  catch_interrupts();
  CHECK_FALSE(interrupted());
  fprintf(stderr, "ready\n");
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (!std::getenv("EYERAY_TEST_STUBBORN")) std::_Exit(7);
  fprintf(stderr, "seen\n");
  std::this_thread::sleep_for(std::chrono::seconds(30));
}

namespace {

std::vector<std::string> waiting_process() {
  return {std::filesystem::read_symlink("/proc/self/exe").string(), "--test-case=wait for signals",
          "--no-skip"};
}

}  // namespace

TEST_CASE("the first signal sets the flag") {
  for (const int signal : {SIGINT, SIGTERM}) {
    Process process(waiting_process());
    REQUIRE(process.wait_for_error_text("ready", 10));
    process.send_signal(signal);
    REQUIRE(process.wait(10));
    CHECK(process.code() == 7);
  }
}

TEST_CASE("the second signal ends the process at once, with 130") {
  Process process(waiting_process(), {{"EYERAY_TEST_STUBBORN", "1"}});
  REQUIRE(process.wait_for_error_text("ready", 10));
  process.send_signal(SIGINT);
  REQUIRE(process.wait_for_error_text("seen", 10));
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  process.send_signal(SIGINT);
  REQUIRE(process.wait(10));
  CHECK(process.code() == 130);
}

TEST_CASE("two signals at once are one") {
  Process process(waiting_process(), {{"EYERAY_TEST_STUBBORN", "1"}});
  REQUIRE(process.wait_for_error_text("ready", 10));
  process.send_signal(SIGTERM);
  process.send_signal(SIGINT);
  REQUIRE(process.wait_for_error_text("seen", 10));
  CHECK_FALSE(process.wait(0.3));
}
