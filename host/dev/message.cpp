#include "host/dev/message.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "host/core/escaped_text.hpp"
#include "host/core/json_depth.hpp"
#include "host/core/stopwatch.hpp"

namespace eyeray::engine::dev {
namespace {

using Sizes = std::array<uint32_t, 2>;  // the sizes of the text and of the bytes

constexpr size_t most_text = size_t{64} << 20;
constexpr size_t most_bytes = size_t{1} << 30;

bool send_all(int socket, const char* data, size_t size) {
  while (size > 0) {
    const ssize_t count = ::send(socket, data, size, MSG_NOSIGNAL);
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) data += count, size -= size_t(count);
  }
  return true;
}

}  // namespace

MessageSocket::MessageSocket(int descriptor) : descriptor_(descriptor) {
  ::fcntl(descriptor_, F_SETFD, FD_CLOEXEC);
}

MessageSocket::MessageSocket(MessageSocket&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), pending_(std::move(other.pending_)) {}

MessageSocket& MessageSocket::operator=(MessageSocket&& other) noexcept {
  close();
  descriptor_ = std::exchange(other.descriptor_, -1);
  pending_ = std::move(other.pending_);
  return *this;
}

void MessageSocket::close() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  pending_.clear();
}

bool MessageSocket::send(const Message& message) {
  const std::string text = json_text(message.json);
  const Sizes sizes{uint32_t(text.size()), uint32_t(message.bytes.size())};
  return !closed() && send_all(descriptor_, reinterpret_cast<const char*>(sizes.data()), sizeof sizes) &&
         send_all(descriptor_, text.data(), text.size()) &&
         send_all(descriptor_, message.bytes.data(), message.bytes.size());
}

bool MessageSocket::readable() const {
  pollfd polled{descriptor_, POLLIN, 0};
  return !pending_.empty() || (!closed() && ::poll(&polled, 1, 0) > 0);
}

// The first message of the pending bytes, if all of it has arrived.
std::optional<Message> MessageSocket::take() {
  Sizes sizes;
  if (pending_.size() < sizeof sizes) return std::nullopt;
  std::memcpy(sizes.data(), pending_.data(), sizeof sizes);
  if (sizes[0] > most_text || sizes[1] > most_bytes) {
    close();
    return std::nullopt;
  }
  const size_t end_of_text = sizeof sizes + sizes[0], end = end_of_text + sizes[1];
  if (pending_.size() < end) {
    pending_.reserve(end);
    return std::nullopt;
  }
  Message message{
      Json::parse(unless_too_deep(std::string_view(pending_).substr(sizeof sizes, sizes[0])), nullptr, false),
      pending_.substr(end_of_text, sizes[1])};
  pending_.erase(0, end);
  if (!message.json.is_object()) {
    close();
    return std::nullopt;
  }
  return message;
}

std::optional<Message> MessageSocket::receive(double seconds) {
  const Stopwatch watch;
  while (!closed()) {
    if (std::optional<Message> message = take()) return message;
    if (closed()) break;
    pollfd polled{descriptor_, POLLIN, 0};
    const double left = std::clamp(seconds - watch.seconds(), 0.0, 3600.0);
    const int ready = ::poll(&polled, 1, int(left * 1000));
    if (ready == 0 || (ready < 0 && errno == EINTR)) return std::nullopt;
    char buffer[65536];
    const ssize_t count = ::read(descriptor_, buffer, sizeof buffer);
    if (count > 0)
      pending_.append(buffer, size_t(count));
    else if (count == 0 || errno != EINTR)
      close();
  }
  return std::nullopt;
}

}  // namespace eyeray::engine::dev
