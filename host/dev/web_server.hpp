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
#include "host/dev/http_server.hpp"

namespace eyeray::engine::dev {

class WebServer {
 public:
  // Gets what the page sends: {"view": …}, {"probe": [x, y]}, …; called from any thread.
  using Command = std::function<void(const Json&)>;

  // Listens on `port`, or on another as HttpServer does. Error (file_io) if there is none.
  WebServer(Board& board, Command command, int port, WebLimits limits = {});
  // Ends what is going on.
  ~WebServer();

  int port() const;
  // "http://127.0.0.1:7447/TOKEN/".
  std::string address() const;

 private:
  struct Site;
  std::unique_ptr<Site> site_;
};

}  // namespace eyeray::engine::dev
