#include "host/dev/guarded_server.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "host/core/stopwatch.hpp"

namespace eyeray::dev {
namespace {

// Whether the socket is ready for `events` within so many seconds.
bool wait_for(socket_t socket, short events, double seconds) {
  pollfd polled{socket, events, 0};
  const Stopwatch watch;
  while (true) {
    const double left = std::max(seconds - watch.seconds(), 0.0);
    const int ready = ::poll(&polled, 1, int(left * 1000));
    if (ready >= 0 || errno != EINTR) return ready > 0;
  }
}

// A client's time for its first byte. It is short because a silent client keeps a thread from others.
constexpr double silent_seconds = 0.25;

// A connection that ends when its request is too large or too slow, or its client does not read.
class GuardedStream final : public httplib::Stream {
 public:
  GuardedStream(socket_t socket, const WebLimits& limits) : socket_(socket), limits_(limits) {}

  bool is_readable() const override { return left() > 0 && wait_for(socket_, POLLIN, left()); }
  bool is_writable() const override { return wait_for(socket_, POLLOUT, limits_.write_seconds); }

  ssize_t read(char* to, size_t size) override {
    // The header comes first, and ends with an empty line; what follows is bounded by the body's limit.
    const size_t most = in_body_ ? limits_.header_bytes + limits_.body_bytes : limits_.header_bytes;
    if (taken_ >= most) return -1;
    if (buffered_ == used_) {
      if (!is_readable()) return -1;
      const ssize_t count = ::recv(socket_, buffer_, sizeof buffer_, 0);
      if (count <= 0) return count;
      buffered_ = size_t(count);
      used_ = 0;
    }
    const size_t count = std::min({size, buffered_ - used_, most - taken_});
    std::copy_n(buffer_ + used_, count, to);
    for (size_t i = 0; i < count && !in_body_; ++i) see(to[i]);
    used_ += count;
    taken_ += count;
    return ssize_t(count);
  }

  ssize_t write(const char* from, size_t size) override {
    size_t done = 0;
    while (done < size) {
      if (!is_writable()) return -1;
      const ssize_t count = ::send(socket_, from + done, size - done, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count < 0 && errno != EINTR && errno != EAGAIN) return -1;
      if (count > 0) done += size_t(count);
    }
    return ssize_t(done);
  }

  // Whether nothing has come.
  bool is_silent() const { return taken_ == 0; }

  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return socket_; }

 private:
  double left() const {
    const double most =
        taken_ == 0 ? std::min(silent_seconds, limits_.request_seconds) : limits_.request_seconds;
    return most - watch_.seconds();
  }
  void see(char c) {
    if (c == '\n')
      in_body_ = ++line_ends_ == 2;
    else if (c != '\r')
      line_ends_ = 0;
  }

  socket_t socket_;
  const WebLimits& limits_;
  Stopwatch watch_;
  char buffer_[4096];
  size_t buffered_ = 0, used_ = 0;
  size_t taken_ = 0;
  int line_ends_ = 0;  // in a row
  bool in_body_ = false;
};

}  // namespace

GuardedServer::GuardedServer(const WebLimits& limits) : limits_(limits) {
  set_payload_max_length(limits.body_bytes);
  new_task_queue = [n = size_t(limits.connections)] { return new httplib::ThreadPool(n); };
}

bool GuardedServer::process_and_close_socket(socket_t socket) {
  GuardedStream stream(socket, limits_);
  bool closed = false;
  const bool answered = process_request(stream, true, closed, nullptr);
  // What the client still sends would turn the close into a reset, and take the answer with it. One that is
  // silent gets no answer, and no more time of this thread.
  ::shutdown(socket, SHUT_WR);
  char rest[4096];
  for (int i = 0; i < 64 && !stream.is_silent() && wait_for(socket, POLLIN, 0.1) &&
                  ::recv(socket, rest, sizeof rest, 0) > 0;
       ++i) {
  }
  ::close(socket);
  return answered;
}

}  // namespace eyeray::dev
