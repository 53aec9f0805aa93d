// The program's end before its time: a signal, or a driver that does not come back.
//
// Work that takes long asks interrupted() between its pieces and ends of its own accord. What cannot ask is
// left where it is: a thread watches, and ends the process a third of a second after it was asked to.
#pragma once

#include <atomic>
#include <functional>

#include "host/core/error.hpp"

namespace eyeray::engine {

// Starts the watch; main calls it, once, and so does a forked child that is to have one. SIGINT, SIGTERM and
// SIGHUP (unless that is ignored, as under nohup) then end the process from whatever state it is in,
// UnfinishedFiles removed; a second one does so even while something is saved. Signals within a tenth of a
// second are one: timeout(1) sends its signal to the process and then to the group. `report` is told why, by
// the watching thread, if standard output and error take it.
void watch_for_termination(std::function<void(const Error&)> report);

// From now on a signal ends the process without a word: who sent it knows.
void end_silently();

// Whether a signal has asked the process to end. Safe from any thread.
bool signalled();

// Whether a signal has asked to stop, or whoever calls eyeray as a library. Safe from any thread.
bool interrupted();

// While one is alive, interrupted() asks `stop` too. One at a time; `stop` must outlive it.
class Interruptible {
 public:
  explicit Interruptible(const std::atomic<bool>& stop);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
};

// Error (interrupted) if one has. For what may compute for ever, of which nothing is worth saving: a pixel.
inline void stop_if_interrupted() {
  if (interrupted()) throw Error(ExitCode::interrupted, "interrupted");
}

// What the process answers to its caller: the code, and where that is `interrupted` 128 + the signal.
int exit_status(ExitCode code);

// Why a command ends that has too little memory.
Error out_of_memory();

// Ends the process with that, from any thread and any signal handler.
[[noreturn]] void end_for_want_of_memory() noexcept;

// While one is alive there is something to lose: the thread asks interrupted(), saves, and ends in its own
// time.
class Saving {
 public:
  Saving();
  ~Saving();
  Saving(const Saving&) = delete;
  Saving& operator=(const Saving&) = delete;
};

// A call of something that does not ask and may not come back, a driver say. If it takes longer than
// `seconds`, in which the process ran, it is to end with `error`; at once where the call does not return,
// else when what is worth it is saved. One at a time; without the watch only passed() tells.
class ForeignCall {
 public:
  ForeignCall(double seconds, Error error);
  ~ForeignCall();
  ForeignCall(const ForeignCall&) = delete;
  ForeignCall& operator=(const ForeignCall&) = delete;

  bool passed() const;
};

}  // namespace eyeray::engine
