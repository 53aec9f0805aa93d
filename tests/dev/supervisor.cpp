// The supervisor, with a worker that sends the messages of the tests.
#include "host/dev/supervisor.hpp"

#include "client.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::dev;

namespace {

// Renders nothing. Until a request has defines, a probe lasts until the next request. On a busy machine the
// supervisor kills such a worker, perhaps before it has read the probe, and starts another.
constexpr const char* worker_script = R"(
import json, socket, struct, sys
end = socket.socket(fileno=int(sys.argv[1]))
def read(count):
    data = b''
    while len(data) < count:
        more = end.recv(count - len(data))
        if not more: sys.exit(0)
        data += more
    return data
def receive():
    text, rest = struct.unpack('<II', read(8))
    message = json.loads(read(text))
    read(rest)
    return message
def send(**message):
    text = json.dumps(message).encode()
    end.sendall(struct.pack('<II', len(text), 0) + text)
render = {}
while True:
    message = receive()
    if message['do'] == 'probe':
        newer = None if render['defines'] else receive()
        send(event='probed', generation=render['generation'], x=message['x'], y=message['y'],
             defines=render['defines'])
        if newer is None: continue
        message = newer
    render = message
    send(event='done', generation=render['generation'], view='gpu', last=True)
)";

class Supervised {
 public:
  Supervised() : supervisor_(options(), [this](const Json& event) { note(event); }) {
    test::write_text(folder_ / "scene.toml", "");
    supervisor_.begin();
    step_until([&] { return done_ > 0; });
  }

  template <typename Condition>
  void step_until(const Condition& condition) {
    for (int i = 0; i < 6000 && !condition(); ++i) supervisor_.step();
    REQUIRE(condition());
  }
  void command(const std::string& json) {
    const size_t path = address_.find('/', 7);
    const std::string host = address_.substr(7, path - 7);
    const test::Client client(std::stoi(host.substr(host.find(':') + 1)));
    client.send(fmt::format(
        "POST {}command HTTP/1.1\r\nHost: {}\r\nOrigin: http://{}\r\nContent-Length: {}\r\n\r\n{}",
        address_.substr(path), host, host, json.size(), json));
    REQUIRE(client.answer().starts_with("HTTP/1.1 204"));
    supervisor_.step();
  }
  Json probe() const { return supervisor_.board().probe(); }
  Json status() const {
    uint64_t seen = 0;
    return Json::parse(*supervisor_.board().next_status(seen, 600));
  }

 private:
  SupervisorOptions options() const {
    SupervisorOptions options;
    options.worker = {"/usr/bin/python3", "-c", worker_script};
    options.scene = folder_ / "scene.toml";
    options.port = 0;
    return options;
  }
  void note(const Json& event) {
    if (event.at("event") == "listening") address_ = event.at("address");
    if (event.at("event") == "done") ++done_;
  }

  test::TemporaryFolder folder_;
  std::string address_;
  int done_ = 0;
  Supervisor supervisor_;
};

}  // namespace

TEST_CASE("a probe that an edit overtakes is repeated, and its answer names the edit") {
  Supervised dev;
  const int first = dev.status().at("edit");
  dev.command(R"({"probe": [3, 4]})");
  dev.command(R"({"defines": {"camera.fov": "30"}})");
  dev.step_until([&] { return !dev.probe().is_null(); });
  CHECK(dev.probe().at("defines") == Json{"camera.fov=30"});
  CHECK(dev.probe().at("x") == 3);
  CHECK(dev.probe().at("edit") == first + 1);

  // Another view is no other picture.
  dev.command(R"({"view": "reference"})");
  CHECK(dev.status().at("edit") == first + 1);
  CHECK(dev.status().at("defines").at("camera.fov") == "30");
  dev.command(R"({"tunables": {"a.glsl:X": [1]}})");
  CHECK(dev.status().at("edit") == first + 2);
  CHECK(dev.status().at("chosen").at("a.glsl:X") == Json::array({1}));
}
