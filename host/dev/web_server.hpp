// The page, on 127.0.0.1 and ::1 only.
//
// Whoever may use this machine can reach a port of it, and so can any web page that a browser on it shows. So
// every path begins with a random token; the Host must be this machine's own name, against names that are
// bound to it later (DNS rebinding); and what changes anything must come from this page (Origin). Nothing is
// served but what the page needs, none of it from a file.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "host/dev/board.hpp"

namespace eyeray::dev {

struct WebLimits {
  size_t header_bytes = 16 << 10;  // of a request
  size_t body_bytes = 1 << 20;
  double request_seconds = 5;  // for a request to arrive in
  double write_seconds = 5;    // for a client to take something in
  int connections = 64;        // at a time; more wait
  int listeners = 8;           // to the status, which keep their connections
};

class WebServer {
 public:
  // What the page asks for: {"view": …}, {"probe": [x, y]}, …; called from any thread.
  using Command = std::function<void(const Json&)>;

  // Listens on `port`, on another where that is taken; 0: any. Error (file_io) where none can be had.
  WebServer(Board& board, Command command, int port, WebLimits limits = {});
  // Ends what is going on.
  ~WebServer();

  int port() const;
  // "http://127.0.0.1:7447/TOKEN/".
  std::string address() const;

 private:
  struct Servers;
  std::unique_ptr<Servers> servers_;
};

}  // namespace eyeray::dev
