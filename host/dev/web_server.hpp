// The web server of the page, on 127.0.0.1 and ::1 only.
//
// Whoever may use this machine can reach a port of it, as can any web page that a browser on it shows.
// Therefore every path begins with a random token. The Host must be a name of this machine itself, as a
// defence against DNS rebinding: foreign names that are later bound to its address. A request that changes
// anything must come from this page (Origin). Only data that the page needs is served, none of it from a
// file.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "host/dev/board.hpp"
#include "host/dev/http_server.hpp"

namespace eyeray::engine::dev {

class WebServer {
 public:
  // Gets the page's commands: {"view": …}, {"probe": [x, y]}, …; called from any thread.
  using Command = std::function<void(const Json&)>;

  // Listens on `port`, or on another as HttpServer does. Error (file_io) if there is none.
  WebServer(Board& board, Command command, int port, WebLimits limits = {});
  // Ends all connections and its threads.
  ~WebServer();

  int port() const;
  // "http://127.0.0.1:7447/TOKEN/".
  std::string address() const;

 private:
  struct Site;
  std::unique_ptr<Site> site_;
};

}  // namespace eyeray::engine::dev
