// An HTTP server for clients of this machine, any of which may be hostile. One thread serves all connections,
// so a client that is silent or slow costs a socket and some kilobytes, and no other client waits for it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace eyeray::engine::dev {

struct WebLimits {
  size_t header_bytes = 16 << 10;  // header bytes of a request
  size_t body_bytes = 1 << 20;
  double request_seconds = 5;  // from accepting a connection to the end of its request
  unsigned write_seconds = 5;  // without a byte that the client accepts
  unsigned connections = 64;   // at a time; one more replaces the oldest one without a complete request
  int listeners = 8;           // connections that receive events
};

struct Request {
  int port = 0;        // port of the server
  std::string method;  // "GET"
  std::string path;    // decoded, without the query
  // By name, in lower case for the header. Values of a repeated name are joined by ", ".
  std::map<std::string, std::string> header, query;
  std::string body;
};

struct Answer {
  int status = 200;
  std::string type;  // a MIME type; empty: without a body
  std::string body;
  bool events = false;  // instead of a body: the texts of publish(), until the client closes the connection
};

class HttpServer {
 public:
  // Answers a whole request. It is called on separate threads, several at a time; an exception from it
  // becomes status 400.
  using Handler = std::function<Answer(Request)>;

  // Listens on 127.0.0.1 and, if this machine has IPv6, on the same port of ::1. A port that is taken is
  // replaced by one of the next 31, or else by any other; 0: any. Error (file_io) if there is no port.
  HttpServer(int port, Handler handler, const WebLimits& limits);
  // Closes all connections, and waits for the running calls of the handler.
  ~HttpServer();

  int port() const;
  // Sends a text to all connections that receive events. A later connection first gets the newest text. A
  // slow one misses all texts but the newest. May be called from any thread.
  void publish(std::string text);

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace eyeray::engine::dev
