// Runs other programs and reads their output.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/core/stopwatch.hpp"

namespace eyeray::engine {

using Environment = std::vector<std::pair<std::string, std::string>>;  // laid over the caller's own

// A running program with an empty standard input; killed and reaped at the latest by the destructor.
class Process {
 public:
  // argv[0] is looked up in PATH. Error (file_io) when it cannot be started.
  explicit Process(const std::vector<std::string>& argv, const Environment& environment = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  // Listens until the program has ended; false when `seconds` pass before.
  bool wait(double seconds);
  // Listens until `text` stands in the output on standard error after position `from` of it; false when
  // `seconds` pass or the program ends before.
  bool wait_for_error_text(const std::string& text, double seconds, size_t from = 0);
  void send_signal(int number);

  // The process's output so far.
  const std::string& out() const { return out_; }
  const std::string& err() const { return err_; }
  // The exit code, or 128 + the signal that ended it; nothing while it runs.
  std::optional<int> code() const { return code_; }
  // Processor time of all its threads in seconds; 0 while it runs.
  double processor_seconds() const { return processor_seconds_; }
  // The number of its minor page faults, which occur where memory is new to it; 0 while it runs.
  long page_faults() const { return page_faults_; }
  pid_t pid() const { return pid_; }

 private:
  bool receive(double seconds);
  void listen(double seconds);

  pid_t pid_ = -1;
  int out_fd_ = -1;
  int err_fd_ = -1;
  std::string out_;
  std::string err_;
  std::optional<int> code_;
  double processor_seconds_ = 0;
  long page_faults_ = 0;
};

// The words that this process was called by, after the path of its program.
std::vector<std::string> own_command();
// Replaces this process by a new start of its program, called by the same words. Error (file_io) where the
// system refuses.
[[noreturn]] void restart(const Environment& environment);

struct ProcessResult {
  int code = 0;  // the exit code; 128 + the signal that ended it; −1 when it was killed after the time-out
  std::string out;
  std::string err;
  double seconds = 0;            // from start to end, on the wall clock
  double processor_seconds = 0;  // processor seconds of all its threads
  long page_faults = 0;
};

// Runs a program to its end. `signal_after_ms` ≥ 0 sends it SIGINT that long after its start.
ProcessResult run_process(const std::vector<std::string>& argv, const Environment& environment = {},
                          double timeout_seconds = 60, int signal_after_ms = -1);

}  // namespace eyeray::engine
