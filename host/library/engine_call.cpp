#include "host/library/engine_call.hpp"

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <mutex>
#include <new>
#include <system_error>
#include <utility>

#include "host/core/option_text.hpp"
#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"

namespace eyeray::engine::library {
namespace {

// The engine's lock, which one call holds at a time. A forked child has none of its parent's threads, so
// their calls hold no lock in it.
struct Engine {
  pid_t process = ::getpid();
  std::timed_mutex mutex;
  std::atomic<uint64_t> callbacks = 0;  // begun and ended: odd while one runs
};

Engine& engine() {
  static std::atomic<Engine*> current = new Engine;
  Engine* known = current;
  if (known->process == ::getpid()) return *known;
  auto* const own = new Engine;
  if (current.compare_exchange_strong(known, own)) return *own;
  delete own;
  return *known;
}

thread_local bool within_call = false;

// The limit on a call's wait for one callback of another call. The callback may itself be waiting for that
// call's thread, and would never return.
constexpr int most_seconds_in_callback = 10;

v0::ErrorKind kind_of(ExitCode code) {
  switch (code) {
    case ExitCode::no_device:
      return v0::ErrorKind::no_device;
    case ExitCode::file_io:
      return v0::ErrorKind::file_io;
    case ExitCode::timed_out:
      return v0::ErrorKind::timed_out;
    case ExitCode::interrupted:
      return v0::ErrorKind::cancelled;
    case ExitCode::internal:
      return v0::ErrorKind::internal;
    default:
      return v0::ErrorKind::bad_input;
  }
}

// Waits for earlier calls, and takes the lock.
std::unique_lock<std::timed_mutex> enter(const std::atomic<bool>* stop) {
  Engine& here = engine();
  std::unique_lock lock(here.mutex, std::defer_lock);
  constexpr std::chrono::milliseconds slice(10);
  WakefulStopwatch watch;
  uint64_t callback = here.callbacks;
  while (!lock.try_lock_for(slice)) {
    if (stop && *stop) throw Error(ExitCode::interrupted, "cancelled");
    if (const uint64_t now = here.callbacks; now != std::exchange(callback, now)) watch = {};
    if (callback % 2 == 1 && watch.seconds() > most_seconds_in_callback)
      throw Error(ExitCode::bad_input,
                  "eyeray was called while `progress` of another call runs, which has not returned for {} "
                  "seconds and may be waiting for this call: let it return first",
                  most_seconds_in_callback);
  }
  return lock;
}

}  // namespace

InsideCall::InsideCall() : before_(std::exchange(within_call, true)) {}
InsideCall::~InsideCall() {
  within_call = before_;
}

InsideCallback::InsideCallback() : callbacks_(engine().callbacks) {
  ++callbacks_;
}
InsideCallback::~InsideCallback() {
  ++callbacks_;
}

std::vector<v0::Diagnostic> to_public(const std::vector<Diagnostic>& diagnostics) {
  std::vector<v0::Diagnostic> all;
  for (const Diagnostic& each : diagnostics)
    all.push_back({each.severity == Severity::error, each.position.file, each.position.line,
                   each.position.column, each.message});
  return all;
}

void call_engine(const std::function<void()>& work, const std::atomic<bool>* stop) {
  try {
    speak_to_library();
    if (within_call)
      throw Error(ExitCode::bad_input,
                  "eyeray was called from within `progress` and would wait for itself: call it after this "
                  "call has returned");
    const InsideCall entered;
    const std::unique_lock lock = enter(stop);
    std::optional<Interruptible> interruptible;
    if (stop) interruptible.emplace(*stop);
    work();
  } catch (const InputError& error) {
    throw v0::Error(kind_of(error.code()), error.what(), to_public(error.diagnostics()));
  } catch (const Error& error) {
    throw v0::Error(kind_of(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    throw v0::Error(v0::ErrorKind::no_device, out_of_memory().what());
  } catch (const std::filesystem::filesystem_error& error) {
    throw v0::Error(v0::ErrorKind::file_io, error.what());
  }
}

}  // namespace eyeray::engine::library
