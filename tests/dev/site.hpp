// The page's server with a picture, and helpers for its clients.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "client.hpp"
#include "host/dev/web_server.hpp"

namespace eyeray::engine::test {

using dev::Json;

struct Site {
  dev::Board board;
  std::mutex mutex;
  std::vector<Json> commands;
  std::function<void()> obey = [] {};
  dev::WebServer server;

  explicit Site(int port = 0, const dev::WebLimits& limits = {})
      : server(
            board,
            [this](const Json& json) {
              obey();
              const std::lock_guard lock(mutex);
              commands.push_back(json);
            },
            port, limits) {
    put_picture("gpu", 2, 1, {0, 0.5f, 1, 2, std::numeric_limits<float>::quiet_NaN(), -1});
  }

  void put_picture(const char* view, int width, int height, const std::vector<float>& values) {
    dev::Message rows{{{"view", view},
                       {"width", width},
                       {"height", height},
                       {"row", 0},
                       {"rows", height},
                       {"stride", 1},
                       {"channels", 3}},
                      ""};
    rows.bytes.assign(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    board.put_rows(rows);
  }

  std::string host() const { return fmt::format("127.0.0.1:{}", server.port()); }
  // "/TOKEN/".
  std::string root() const {
    const std::string address = server.address();
    return address.substr(address.find('/', 7));
  }
  std::string ask(const std::string& request) const {
    const Client client(server.port());
    client.send(request);
    return client.answer();
  }
  std::string get(const std::string& path, const std::string& headers = "") const {
    return ask("GET " + path + " HTTP/1.1\r\nHost: " + host() + "\r\n" + headers + "\r\n");
  }
  std::string post(const std::string& body, const std::string& headers) const {
    return ask(fmt::format("POST {}command HTTP/1.1\r\nHost: {}\r\nContent-Length: {}\r\n{}\r\n{}", root(),
                           host(), body.size(), headers, body));
  }
  std::string own_origin() const { return "Origin: http://" + host() + "\r\n"; }
};

inline int status(const std::string& answer) {
  return answer.size() > 12 && answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : 0;
}

inline std::string body(const std::string& answer) {
  const size_t end = answer.find("\r\n\r\n");
  return end == std::string::npos ? "" : answer.substr(end + 4);
}

inline std::vector<std::unique_ptr<Client>> clients(const Site& site, int count) {
  std::vector<std::unique_ptr<Client>> list;
  for (int i = 0; i < count; ++i) list.push_back(std::make_unique<Client>(site.server.port()));
  return list;
}

}  // namespace eyeray::engine::test
