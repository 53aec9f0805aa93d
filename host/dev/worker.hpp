// A child process for work that may crash or never end: a user's shader on a driver that cannot be
// interrupted.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <utility>

namespace eyeray::dev {

class Worker {
 public:
  // Answers one request with one line of text, in the child. The child lives from request to request, so that
  // what it keeps (device, caches) stays warm. It must not throw.
  using Serve = std::function<std::string(const std::string& request)>;

  // The child is forked at the first request, and again after it has died; the caller must have no other
  // threads.
  explicit Worker(Serve serve) : serve_(std::move(serve)) {}
  ~Worker() { kill(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  enum class Outcome { answered, timed_out, died, interrupted };
  struct Answer {
    Outcome outcome;
    std::string text;  // answered: the line, without its end; died: how, "signal 11 (Segmentation fault)"
  };
  // Requests and answers hold no line breaks. A child that ended between two requests is replaced without a
  // word. Whatever the outcome but `answered`, the child is gone afterwards.
  Answer ask(const std::string& request, double timeout_seconds);
  // Ends the child, whatever it does: soon, and with its unfinished files gone.
  void kill();

 private:
  void start();
  bool has_ended() const;
  Answer bury();

  Serve serve_;
  pid_t pid_ = -1;
  int socket_ = -1;  // to the child
};

}  // namespace eyeray::dev
