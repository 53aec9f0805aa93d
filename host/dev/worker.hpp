// A process for work that may crash or never end: a user's shader on a driver that cannot be interrupted.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "host/dev/message.hpp"

namespace eyeray::engine::dev {

// The supervisor's hand on it.
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
  // True if a debugger is attached to it, and may hold it for as long as a person thinks.
  bool debugged() const;
  // Ends it in any state: soon, and with its unfinished files gone. Returns how it ended, for people: "signal
  // 11 (Segmentation fault)"; a process that ends by itself does so before it is killed.
  std::string kill();

 private:
  bool has_ended() const;

  std::vector<std::string> command_;
  pid_t pid_ = -1;
  MessageSocket socket_;
};

// In the worker, before anything else: it ends when the process that started it does, leaves Ctrl-C to it,
// and is called eyeray-worker.
void be_a_worker();

}  // namespace eyeray::engine::dev
