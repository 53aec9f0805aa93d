// Ends the program before its time: at a signal, or if a call of a driver does not return.
//
// Long work calls interrupted() between its pieces, and ends by itself. Code that cannot call it is left
// where it is: a watching thread ends the process a third of a second after the request to end.
#pragma once

#include <atomic>
#include <functional>

#include "host/core/error.hpp"

namespace eyeray::engine {

// Starts the watch. main calls this once; a forked child that needs a watch calls it too. SIGINT, SIGTERM and
// SIGHUP (unless that is ignored, as under nohup) then end the process from any state, with UnfinishedFiles
// removed; a second signal does so even while something is saved. Signals within a tenth of a second count as
// one: timeout(1) sends its signal to the process and then to the group. The watching thread calls `report`
// with the reason, if standard output and error take it.
void watch_for_termination(std::function<void(const Error&)> report);

// From now on a signal ends the process without a message: its sender knows of it.
void end_silently();

// True if a signal has requested the process's end. Safe from any thread.
bool signalled();

// True if a signal, or a program that uses eyeray as a library, has requested a stop. Safe from any thread.
bool interrupted();

// While one is alive, interrupted() queries `stop` too. One at a time; `stop` must outlive it.
class Interruptible {
 public:
  explicit Interruptible(const std::atomic<bool>& stop);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
};

// Throws Error (interrupted) if interrupted(). For work that may never end and is not worth saving in part: a
// pixel.
inline void stop_if_interrupted() {
  if (interrupted()) throw Error(ExitCode::interrupted, "interrupted");
}

// The exit status of the process: the code, or 128 + the signal if the code is `interrupted`.
int exit_status(ExitCode code);

// The error with which a command ends that has too little memory.
Error out_of_memory();

// Ends the process with out_of_memory(), from any thread and any signal handler.
[[noreturn]] void end_for_want_of_memory() noexcept;

// While one is alive there is something to save: its thread queries interrupted(), saves, and ends in its own
// time.
class Saving {
 public:
  Saving();
  ~Saving();
  Saving(const Saving&) = delete;
  Saving& operator=(const Saving&) = delete;
};

// A call that cannot be interrupted and may not return, of a driver for instance. If it takes longer than
// `seconds` of the process's running time, the process ends with `error`: at once if the call does not
// return, else when the results worth saving are saved. One call at a time. Without the watch nothing ends
// the process; only passed() reports the excess.
class ForeignCall {
 public:
  ForeignCall(double seconds, Error error);
  ~ForeignCall();
  ForeignCall(const ForeignCall&) = delete;
  ForeignCall& operator=(const ForeignCall&) = delete;

  bool passed() const;
};

}  // namespace eyeray::engine
