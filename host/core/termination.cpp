#include "host/core/termination.hpp"

#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <mutex>
#include <optional>
#include <utility>

#include "host/core/stopwatch.hpp"
#include "host/core/unfinished_files.hpp"

namespace eyeray::engine {
namespace {

constexpr int64_t second = 1'000'000'000;  // in nanoseconds
constexpr int64_t one_signal = second / 10;
constexpr double grace_seconds = 0.3;
constexpr int64_t tick = second / 50;  // interval of the watch, while it measures time
constexpr size_t stack_bytes = 256 << 10;

// The variables that a signal handler may access.
std::atomic<int64_t> first_signal = 0;  // time of the first signal, on the monotonic clock; 0: none came
std::atomic<int> signal_number = SIGINT;
std::atomic<bool> insisted = false;
std::atomic<bool> without_memory = false;
std::atomic<bool> silent = false;
static_assert(std::atomic<int64_t>::is_always_lock_free, "a signal handler may only touch lock-free atomics");
struct Semaphore {
  sem_t handle;
  Semaphore() { ::sem_init(&handle, 0, 0); }
} something_happened;

std::atomic<int> saving = 0;
std::atomic<const std::atomic<bool>*> stop_requested = nullptr;

// The current foreign call. If it has exceeded its limit, it stays here even after it returns.
struct Call {
  double limit;
  Error error;
  WakefulStopwatch clock;
  bool returned = false;
};
std::mutex call_mutex;
std::optional<Call> call;

int64_t nanoseconds_now() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * second + time.tv_nsec;
}

extern "C" void on_signal(int number) {
  const int kept_errno = errno;
  const int64_t now = nanoseconds_now();
  int64_t first = 0;
  if (first_signal.compare_exchange_strong(first, now))
    signal_number = number;
  else if (now - first > one_signal)
    insisted = true;
  ::sem_post(&something_happened.handle);
  errno = kept_errno;
}

bool can_write(int file) {
  pollfd polled{file, POLLOUT, 0};
  return ::poll(&polled, 1, 0) == 1 && (polled.revents & POLLOUT);
}

// Other threads may be in any code and hold any lock: nothing here waits for them.
[[noreturn]] void end(const std::function<void(const Error&)>& report, const Error& error) {
  if (can_write(STDOUT_FILENO) && can_write(STDERR_FILENO) && ::ftrylockfile(stdout) == 0 &&
      ::ftrylockfile(stderr) == 0) {
    if (!silent || error.code() != ExitCode::interrupted) report(error);
    std::fflush(stdout);
  }
  remove_unfinished_files();
  ::_exit(exit_status(error.code()));
}

// The reason for ending the process; empty if it need not end.
std::optional<Error> reason_to_end() {
  if (without_memory) return out_of_memory();
  if (signalled()) return Error(ExitCode::interrupted, "interrupted");
  const std::lock_guard lock(call_mutex);
  if (call && call->clock.seconds() >= call->limit) return call->error;
  return std::nullopt;
}

bool in_foreign_call() {
  const std::lock_guard lock(call_mutex);
  return call && !call->returned;
}

void wait_for_tick() {
  const int64_t until = nanoseconds_now() + tick;
  const timespec time{until / second, until % second};
  ::sem_clockwait(&something_happened.handle, CLOCK_MONOTONIC, &time);
}

[[noreturn]] void watch(const std::function<void(const Error&)>& report) {
  std::optional<WakefulStopwatch> since;  // time since the process should end and nothing is being saved
  while (true) {
    const std::optional<Error> reason = reason_to_end();
    if (!reason || (saving > 0 && !in_foreign_call()))
      since.reset();
    else if (!since)
      since.emplace();
    if (reason && (insisted || without_memory || (since && since->seconds() >= grace_seconds)))
      end(report, *reason);
    if (reason || in_foreign_call())
      wait_for_tick();
    else
      ::sem_wait(&something_happened.handle);
  }
}

extern "C" void* watching_thread(void* report) {
  watch(*static_cast<std::function<void(const Error&)>*>(report));
}

void catch_signals() {
  struct sigaction action{};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before{};
    CHECK_EQ(::sigaction(number, nullptr, &before), 0);
    if (number == SIGHUP && before.sa_handler == SIG_IGN) continue;
    CHECK_EQ(::sigaction(number, &action, nullptr), 0);
  }
}

}  // namespace

void watch_for_termination(std::function<void(const Error&)> report) {
  catch_signals();
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, stack_bytes);
  pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
  pthread_t thread;
  // Never destroyed: the thread outlives main.
  auto* const kept_report = new std::function<void(const Error&)>(std::move(report));
  const int failure = ::pthread_create(&thread, &attributes, watching_thread, kept_report);
  pthread_attr_destroy(&attributes);
  if (failure != 0) throw Error(ExitCode::file_io, "cannot start a thread: {}", strerror(failure));
}

void end_silently() {
  silent = true;
}

bool signalled() {
  return first_signal.load(std::memory_order_relaxed) != 0;
}

bool interrupted() {
  const std::atomic<bool>* const requested = stop_requested.load(std::memory_order_acquire);
  return signalled() || (requested && requested->load(std::memory_order_relaxed));
}

Interruptible::Interruptible(const std::atomic<bool>& stop) {
  const std::atomic<bool>* none = nullptr;
  CHECK(stop_requested.compare_exchange_strong(none, &stop, std::memory_order_release));
}

Interruptible::~Interruptible() {
  stop_requested = nullptr;
}

int exit_status(ExitCode code) {
  return code == ExitCode::interrupted ? 128 + signal_number : int(code);
}

Error out_of_memory() {
  return {ExitCode::no_device, "out of memory; allow more (ulimit), or try a smaller picture or scene"};
}

// Leaves the message to the watching thread, which is intact. If that has no memory either, writes a fixed
// message after a second and exits.
void end_for_want_of_memory() noexcept {
  without_memory = true;
  ::sem_post(&something_happened.handle);
  const timespec time{1, 0};
  ::clock_nanosleep(CLOCK_MONOTONIC, 0, &time, nullptr);
  constexpr char words[] = "eyeray: error: out of memory\n";
  if (::write(STDERR_FILENO, words, sizeof words - 1) >= 0) errno = 0;
  ::_exit(int(ExitCode::no_device));
}

Saving::Saving() {
  ++saving;
}

Saving::~Saving() {
  --saving;
}

ForeignCall::ForeignCall(double seconds, Error error) {
  {
    const std::lock_guard lock(call_mutex);
    CHECK(!call || call->returned);
    call = Call{seconds, std::move(error), {}};
  }
  ::sem_post(&something_happened.handle);
}

ForeignCall::~ForeignCall() {
  const std::lock_guard lock(call_mutex);
  if (call->clock.seconds() >= call->limit)
    call->returned = true;
  else
    call.reset();
}

bool ForeignCall::passed() const {
  const std::lock_guard lock(call_mutex);
  return call->clock.seconds() >= call->limit;
}

}  // namespace eyeray::engine
