// A process for work that may crash or never end: a user's shader on a driver that cannot be interrupted.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "host/dev/message.hpp"

namespace eyeray::engine::dev {

// The supervisor's handle of such a process.
class Worker {
 public:
  // The program and its arguments; start() appends the descriptor of the worker's socket.
  explicit Worker(std::vector<std::string> command) : command_(std::move(command)) {}
  ~Worker() { kill(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // Starts the process. Error (file_io) when the system has no room for one.
  void start();
  bool running() const { return pid_ >= 0; }
  MessageSocket& socket() { return socket_; }
  // True if a debugger is attached to the process, and may stop it for as long as a person thinks.
  bool debugged() const;
  // Ends the process soon, whatever its state, and removes its unfinished files. It may first end by itself,
  // and is killed otherwise. Returns how it ended, for people: "signal 11 (Segmentation fault)".
  std::string kill();

 private:
  bool has_ended() const;

  std::vector<std::string> command_;
  pid_t pid_ = -1;
  MessageSocket socket_;
};

// To be called first in the worker process. It then ends when the process that started it ends, leaves Ctrl-C
// to that process, and is called eyeray-worker.
void be_a_worker();

}  // namespace eyeray::engine::dev
