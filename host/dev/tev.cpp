#include "host/dev/tev.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include "host/core/error.hpp"

namespace eyeray::dev {
namespace {

constexpr int most_milliseconds_to_wait = 2000;
constexpr std::array<const char*, 3> channels{"R", "G", "B"};

// A packet is its length, itself included, and what follows, little-endian.
class Packet {
 public:
  explicit Packet(char type) : bytes_(4, 0) { bytes_ += type; }
  Packet& add(int32_t number) { return raw(&number, sizeof number); }
  Packet& add(int64_t number) { return raw(&number, sizeof number); }
  Packet& add(bool flag) {
    bytes_ += char(flag);
    return *this;
  }
  Packet& add(const std::string& text) { return raw(text.c_str(), text.size() + 1); }
  Packet& raw(const void* data, size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
    return *this;
  }
  std::string take() {
    const auto size = uint32_t(bytes_.size());
    std::memcpy(bytes_.data(), &size, sizeof size);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

void add_channels(Packet& packet) {
  packet.add(int32_t(channels.size()));
  for (const char* channel : channels) packet.add(std::string(channel));
}

std::string create(const std::string& name, const image::Image& picture) {
  Packet packet(4);
  packet.add(true).add(name).add(int32_t(picture.width())).add(int32_t(picture.height()));
  add_channels(packet);
  return packet.take();
}

std::string update(const std::string& name, const image::Image& picture) {
  Packet packet(6);
  packet.add(false).add(name);
  add_channels(packet);
  packet.add(int32_t{0}).add(int32_t{0}).add(int32_t(picture.width())).add(int32_t(picture.height()));
  // Where in the data each channel begins, and how far its samples are apart.
  for (size_t c = 0; c < channels.size(); ++c) packet.add(int64_t(c));
  for (size_t c = 0; c < channels.size(); ++c) packet.add(int64_t(channels.size()));
  packet.raw(picture.samples().data(), picture.sample_count() * sizeof(float));
  return packet.take();
}

}  // namespace

Tev::Tev(const std::string& address) {
  const size_t colon = address.rfind(':');
  if (!address.empty()) host_ = address.substr(0, colon);
  if (colon != std::string::npos) port_ = address.substr(colon + 1);
  if (host_.empty() || port_.empty() || port_.size() > 5 ||
      port_.find_first_not_of("0123456789") != port_.npos)
    throw Error(ExitCode::bad_input, "--tev is HOST:PORT, as 127.0.0.1:14158, not '{}'", address);
}

Tev::~Tev() {
  close();
}

void Tev::close() {
  if (socket_ >= 0) ::close(std::exchange(socket_, -1));
}

bool Tev::connect() {
  if (socket_ >= 0) return true;
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  if (::getaddrinfo(host_.c_str(), port_.c_str(), &wanted, &list) != 0) return false;
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> all(list, ::freeaddrinfo);
  for (const addrinfo* each = all.get(); each; each = each->ai_next) {
    socket_ = ::socket(each->ai_family, each->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, each->ai_protocol);
    if (socket_ < 0) continue;
    const bool begun = ::connect(socket_, each->ai_addr, each->ai_addrlen) == 0 || errno == EINPROGRESS;
    pollfd polled{socket_, POLLOUT, 0};
    int failure = 0;
    socklen_t size = sizeof failure;
    if (begun && ::poll(&polled, 1, most_milliseconds_to_wait) > 0 &&
        ::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &failure, &size) == 0 && failure == 0)
      return true;
    close();
  }
  return false;
}

bool Tev::send(const std::string& packet) {
  for (size_t done = 0; done < packet.size();) {
    pollfd polled{socket_, POLLOUT, 0};
    if (::poll(&polled, 1, most_milliseconds_to_wait) <= 0) return false;
    const ssize_t count = ::send(socket_, packet.data() + done, packet.size() - done, MSG_NOSIGNAL);
    if (count < 0 && errno != EINTR && errno != EAGAIN) return false;
    if (count > 0) done += size_t(count);
  }
  return true;
}

std::string Tev::show(const std::string& name, const image::Image& picture) {
  if (!connect()) return fmt::format("no tev at {}:{}", host_, port_);
  if (send(create(name, picture)) && send(update(name, picture))) return "";
  close();
  return fmt::format("tev at {}:{} does not take pictures", host_, port_);
}

}  // namespace eyeray::dev
