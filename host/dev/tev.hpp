// Pictures for the image viewer tev (https://github.com/Tom94/tev), by its protocol over TCP.
#pragma once

#include <string>

#include "host/image/image.hpp"

namespace eyeray::dev {

class Tev {
 public:
  // "HOST:PORT", "HOST" or "" for 127.0.0.1:14158, where tev listens. Connects to nobody yet. Error
  // (bad_input) where it is no address.
  explicit Tev(const std::string& address);
  ~Tev();
  Tev(const Tev&) = delete;
  Tev& operator=(const Tev&) = delete;

  // Shows a picture of three channels, in place of the last one of that name. What went wrong, for people; ""
  // when nothing did. A viewer that is not there, or does not take it within two seconds, is tried again next
  // time.
  std::string show(const std::string& name, const image::Image& picture);

 private:
  bool connect();
  bool send(const std::string& packet);
  void close();

  std::string host_ = "127.0.0.1", port_ = "14158";
  int socket_ = -1;
};

}  // namespace eyeray::dev
