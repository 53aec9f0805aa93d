// cpp-httplib's server for a place where clients may be hostile: it bounds what a request may weigh and how
// long it may take, which the library does for each line and each read alone.
#pragma once

#include <httplib.h>

#include "host/dev/web_server.hpp"

namespace eyeray::dev {

class GuardedServer final : public httplib::Server {
 public:
  explicit GuardedServer(const WebLimits& limits);

 private:
  // One request a connection.
  bool process_and_close_socket(socket_t socket) override;

  WebLimits limits_;
};

}  // namespace eyeray::dev
