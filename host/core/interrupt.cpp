#include "core/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "core/error.hpp"

namespace eyeray {

namespace {

std::atomic<bool> stop_asked = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void on_signal(int) {
  if (stop_asked.exchange(true)) ::_exit(int(ExitCode::interrupted));
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) CHECK_EQ(::sigaction(signal, &action, nullptr), 0);
}

bool interrupted() {
  return stop_asked.load(std::memory_order_relaxed);
}

}  // namespace eyeray
