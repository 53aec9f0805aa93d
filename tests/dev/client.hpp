// Plain TCP, for tests of the page's server.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace eyeray::engine::test {

// A client of a server on this machine that sends arbitrary text.
class Client {
 public:
  explicit Client(int port, const char* address = "127.0.0.1") {
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(uint16_t(port));
    inet_pton(AF_INET, address, &to.sin_addr);
    connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0;
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  bool connected() const { return connected_; }
  // True if the other end has taken the text.
  bool send(const std::string& text) const {
    for (size_t done = 0; done < text.size();) {
      const ssize_t count = ::send(socket_, text.data() + done, text.size() - done, MSG_NOSIGNAL);
      if (count <= 0) return false;
      done += size_t(count);
    }
    return true;
  }
  // Everything that arrives until the other end closes the connection, or until `text` has arrived.
  std::string answer(const std::string& text = "") const {
    std::string all;
    char buffer[65536];
    for (ssize_t count; (count = ::recv(socket_, buffer, sizeof buffer, 0)) > 0;) {
      all.append(buffer, size_t(count));
      if (!text.empty() && all.find(text) != std::string::npos) break;
    }
    return all;
  }

 private:
  int socket_;
  bool connected_;
};

}  // namespace eyeray::engine::test
