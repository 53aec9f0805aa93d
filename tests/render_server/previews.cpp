// The pictures that the worker of dev shows while a kernel compiles.
#include <sys/socket.h>

#include <thread>

#include "host/dev/board.hpp"
#include "host/dev/render_server.hpp"
#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::dev;

namespace {

constexpr const char* text = R"(
[image]
width = 40
height = 30
samples = 4
[camera]
eye = [0, 0, 4]
target = [0, 0, 0]
[[light]]
type = "point"
position = [2, 4, 5]
intensity = 60
[[material]]
name = "stripes"
type = "phong"
[material.diffuse.formula]
code = "vec3 color(vec2 uv) { return vec3(fract(uv * stripes), 0.5); }"
parameters = { stripes = 7.5 }
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "stripes"
)";

// A RenderServer on a thread, and the messages that it has sent.
class Served {
 public:
  Served() {
    int ends[2];
    REQUIRE(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0);
    socket_ = MessageSocket(ends[0]);
    RenderServer::Options options;
    options.load = [](const std::vector<std::string>& defines) {
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

  void ask(int revision, const std::string& define, bool previews) {
    REQUIRE(socket_.send({{{"do", "render"},
                           {"revision", revision},
                           {"generation", revision},
                           {"shaders_changed", false},
                           {"defines", Json::array({define})},
                           {"views", {"gpu"}},
                           {"previews", previews}},
                          ""}));
  }
  // The next message of that revision; its rows are put on the board.
  Json next(int revision) {
    while (true) {
      const auto message = socket_.receive(600);
      REQUIRE(message);
      if (message->json.at("generation") != revision) continue;
      if (message->json.at("event") == "rows") board.put_rows(*message);
      INFO(message->json.dump());
      REQUIRE(message->json.at("event") != "failed");
      return message->json;
    }
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

bool is_preview(const Json& rows) {
  return rows.at("preview");
}

}  // namespace

TEST_CASE("the twin shows the picture until the kernel is ready, which changes no bit of it") {
  Served served;
  served.ask(1, "material.0.diffuse.formula.parameters.stripes=5", true);
  const std::vector<Json> rows = served.rows(1);
  CHECK(is_preview(rows.front()));
  CHECK(rows.front().at("stride") == 8);
  CHECK_FALSE(is_preview(rows.back()));
  CHECK(rows.back().at("sample") == 3);
  // Shown rows are not replaced by coarser ones.
  const auto first = std::ranges::find_if_not(rows, is_preview);
  CHECK(std::ranges::none_of(first, rows.end(), is_preview));
  CHECK(first->at("stride") == 1);
  CHECK(first->at("sample") >= std::prev(first)->at("sample"));
  const std::vector<float> with_preview = served.picture();

  served.ask(2, "material.0.diffuse.formula.parameters.stripes=5", false);
  CHECK(std::ranges::none_of(served.rows(2), is_preview));
  CHECK(served.picture() == with_preview);
}

TEST_CASE("a newer edit ends a preview, though the kernel of the older one still compiles") {
  Served served;
  served.ask(1, "material.0.diffuse.formula.parameters.stripes=5", true);
  while (served.next(1).at("event") != "rows") {
  }
  const std::string newer =
      "material.0.diffuse.formula.code=\"vec3 color(vec2 uv) { return vec3(sin(uv * stripes), 1.0); }\"";
  served.ask(2, newer, true);
  served.rows(2);
  const std::vector<float> picture = served.picture();
  served.ask(3, newer, false);
  served.rows(3);
  CHECK(served.picture() == picture);
}

TEST_CASE("colours have the scene's tone; a metered exposure is that of the first rows") {
  Served served;
  served.ask(1, "image.exposure=-1.5", false);
  for (const Json& rows : served.rows(1)) CHECK(rows.at("tone").at("exposure") == -1.5);
  CHECK(served.board.picture("gpu")->tone.exposure == -1.5);
  served.ask(2, "image.exposure=auto", true);
  const std::vector<Json> rows = served.rows(2);
  for (const Json& each : rows) CHECK(each.at("tone") == rows.front().at("tone"));
  const double exposure = rows.front().at("tone").at("exposure");
  served.ask(3, "render.background=0", false);
  CHECK(served.rows(3).front().at("tone").at("exposure") == 0);
  CHECK(exposure != 0);
}
