// A RenderServer that gets the requests of a supervisor.
#pragma once

#include <sys/socket.h>

#include <string>
#include <thread>
#include <vector>

#include "host/dev/board.hpp"
#include "host/dev/render_server.hpp"
#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

namespace eyeray::engine::test {

using namespace dev;

// A RenderServer on a thread, and the messages that it has sent.
class Served {
 public:
  explicit Served(const std::string& text) {
    int ends[2];
    REQUIRE(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0);
    socket_ = MessageSocket(ends[0]);
    RenderServer::Options options;
    options.load = [text](const std::vector<std::string>& defines) {
      std::vector<loader::Override> overrides;
      for (const std::string& define : defines) overrides.push_back({define});
      return loader::parse_scene(text, "scene.toml", overrides);
    };
    options.unnoticed_seconds = 0;
    thread_ = std::thread([options, end = ends[1]] { RenderServer(options, MessageSocket(end)).serve(); });
  }
  ~Served() {
    socket_.close();
    thread_.join();
  }

  void ask(int revision, const std::string& define, bool previews,
           const std::vector<std::string>& views = {"gpu"}) {
    REQUIRE(socket_.send({{{"do", "render"},
                           {"revision", revision},
                           {"generation", revision},
                           {"shaders_changed", false},
                           {"defines", Json::array({define})},
                           {"views", views},
                           {"previews", previews}},
                          ""}));
  }
  // The next message; its rows are put on the board.
  Json next() {
    const auto message = socket_.receive(600);
    REQUIRE(message);
    if (message->json.at("event") == "rows") board.put_rows(*message);
    INFO(message->json.dump());
    REQUIRE(message->json.at("event") != "failed");
    return message->json;
  }
  // The next message of that revision.
  Json next(int revision) {
    Json message = next();
    while (message.at("generation") != revision) message = next();
    return message;
  }
  // The rows of a revision until it is done.
  std::vector<Json> rows(int revision) {
    std::vector<Json> rows;
    for (Json json = next(revision); json.at("event") != "done"; json = next(revision))
      if (json.at("event") == "rows") rows.push_back(std::move(json));
    return rows;
  }
  std::vector<float> picture() const { return board.picture("gpu")->image.samples(); }

  Board board;

 private:
  MessageSocket socket_;
  std::thread thread_;
};

}  // namespace eyeray::engine::test
