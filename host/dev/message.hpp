// Messages between the supervisor and its worker.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace eyeray::engine::dev {

using Json = nlohmann::ordered_json;

// A JSON document, and raw bytes that go with it: pixels.
struct Message {
  Json json;
  std::string bytes;
};

// One end of a pair of sockets. A message is two little-endian uint32, the sizes of the JSON text and of the
// bytes, followed by the text and the bytes. The other end may be a process whose memory a shader has
// overwritten: bytes that are no message close the socket.
class MessageSocket {
 public:
  MessageSocket() = default;  // closed
  // Sets FD_CLOEXEC: child processes do not inherit the descriptor.
  explicit MessageSocket(int descriptor);
  ~MessageSocket() { close(); }
  MessageSocket(MessageSocket&& other) noexcept;
  MessageSocket& operator=(MessageSocket&& other) noexcept;

  // The socket's descriptor, to poll for reading; -1 once closed.
  int descriptor() const { return descriptor_; }
  bool closed() const { return descriptor_ < 0; }
  void close();

  // True if all of the message was sent.
  bool send(const Message& message);
  // The next message, if all of it arrives within `seconds`.
  std::optional<Message> receive(double seconds);
  // True if there is something to receive, or the other end is gone.
  bool readable() const;

 private:
  std::optional<Message> take();

  int descriptor_ = -1;
  std::string pending_;
};

}  // namespace eyeray::engine::dev
