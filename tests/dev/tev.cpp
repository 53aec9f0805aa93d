// What tev is sent.
#include "host/dev/tev.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <thread>

#include "host/core/error.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::dev;

namespace {

// Listens on a port of its own, and takes what the first client sends.
class Listener {
 public:
  Listener() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof own;
    REQUIRE(::bind(socket_, reinterpret_cast<sockaddr*>(&own), sizeof own) == 0);
    REQUIRE(::listen(socket_, 1) == 0);
    REQUIRE(::getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &size) == 0);
    port_ = ntohs(own.sin_port);
  }
  ~Listener() { ::close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  std::string take() const {
    const int client = ::accept(socket_, nullptr, nullptr);
    std::string all;
    char buffer[4096];
    for (ssize_t count; (count = ::read(client, buffer, sizeof buffer)) > 0;)
      all.append(buffer, size_t(count));
    ::close(client);
    return all;
  }

 private:
  int socket_;
  int port_ = 0;
};

template <typename Number>
Number number_at(const std::string& bytes, size_t at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

}  // namespace

TEST_CASE("a picture is made and filled by two packets") {
  const Listener listener;
  image::Image picture(2, 1, 3);
  for (size_t i = 0; i < 6; ++i) picture.samples()[i] = float(i) / 4;
  std::string sent;
  {
    std::thread viewer([&] { sent = listener.take(); });
    {
      Tev tev(listener.address());
      CHECK(tev.show("gpu", picture) == "");
    }
    viewer.join();
  }
  // length, type, focus, "gpu", width, height, three names
  const size_t first = 4 + 1 + 1 + 4 + 8 + 4 + 6;
  REQUIRE(number_at<uint32_t>(sent, 0) == first);
  CHECK(sent.substr(4, 6) == std::string("\x04\x01gpu\0", 6));
  CHECK(number_at<int32_t>(sent, 10) == 2);
  CHECK(number_at<int32_t>(sent, 14) == 1);
  CHECK(number_at<int32_t>(sent, 18) == 3);
  CHECK(sent.substr(22, 6) == std::string("R\0G\0B\0", 6));
  // length, type, focus, "gpu", three names, x, y, width, height, three offsets, three strides, pixels
  REQUIRE(sent.size() == first + 4 + 1 + 1 + 4 + 4 + 6 + 16 + 24 + 24 + 24);
  CHECK(number_at<uint32_t>(sent, first) == sent.size() - first);
  CHECK(sent[first + 4] == 6);
  CHECK(number_at<int32_t>(sent, first + 28) == 2);
  CHECK(number_at<int64_t>(sent, first + 36 + 8) == 1);
  CHECK(number_at<int64_t>(sent, first + 60) == 3);
  CHECK(number_at<float>(sent, sent.size() - 4) == 1.25f);
}

TEST_CASE("a viewer that is not there is told, and an address that is none refused") {
  std::string address;
  {
    const Listener gone;
    address = gone.address();
  }
  Tev tev(address);
  CHECK(tev.show("gpu", image::Image(1, 1, 3)) == "no tev at " + address);
  for (const char* wrong : {":", "host:", "host:port", ":1", "host:123456"})
    CHECK_THROWS_AS(Tev{wrong}, Error);
}
