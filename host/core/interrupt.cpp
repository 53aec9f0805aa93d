#include "core/interrupt.hpp"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>

#include "core/error.hpp"

namespace eyeray {

namespace {

constexpr int64_t one_signal_nanoseconds = 100'000'000;

// When the first signal came, on the monotonic clock; 0: none did.
std::atomic<int64_t> first_signal = 0;
static_assert(std::atomic<int64_t>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void on_signal(int) {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  const int64_t now = int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  int64_t first = 0;
  if (first_signal.compare_exchange_strong(first, now)) return;
  if (now - first > one_signal_nanoseconds) ::_exit(int(ExitCode::interrupted));
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
  return first_signal.load(std::memory_order_relaxed) != 0;
}

}  // namespace eyeray
