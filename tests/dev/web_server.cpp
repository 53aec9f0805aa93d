// The page's server, and clients that mean no good.
#include "host/dev/web_server.hpp"

#include <unistd.h>

#include <atomic>
#include <fstream>
#include <mutex>
#include <thread>

#include "client.hpp"
#include "host/core/stopwatch.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::dev;
using eyeray::test::Client;

namespace {

struct Site {
  Board board;
  std::mutex mutex;
  std::vector<Json> commands;
  WebServer server;

  explicit Site(int port = 0, const WebLimits& limits = {})
      : server(
            board,
            [this](const Json& json) {
              const std::lock_guard lock(mutex);
              commands.push_back(json);
            },
            port, limits) {
    Message rows{{{"view", "gpu"},
                  {"width", 2},
                  {"height", 1},
                  {"row", 0},
                  {"rows", 1},
                  {"stride", 1},
                  {"channels", 3}},
                 ""};
    const float values[6] = {0, 0.5f, 1, 2, std::numeric_limits<float>::quiet_NaN(), -1};
    rows.bytes.assign(reinterpret_cast<const char*>(values), sizeof values);
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

int status(const std::string& answer) {
  return answer.size() > 12 && answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : 0;
}

size_t resident_bytes() {
  size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * size_t(::sysconf(_SC_PAGESIZE));
}

}  // namespace

TEST_CASE("the page, its pictures and values are served under the token") {
  const Site site;
  const std::string page = site.get(site.root());
  CHECK(status(page) == 200);
  CHECK(page.find("<title>eyeray dev</title>") != std::string::npos);
  for (const char* header : {"Content-Security-Policy: default-src 'none'", "X-Content-Type-Options: nosniff",
                             "Referrer-Policy: no-referrer", "Cache-Control: no-store"})
    CHECK(page.find(header) != std::string::npos);
  CHECK(page.find("Access-Control-Allow") == std::string::npos);
  CHECK(status(site.get(site.root() + "main.mjs")) == 200);

  const std::string png = site.get(site.root() + "frame?view=gpu");
  CHECK(png.find("Content-Type: image/png") != std::string::npos);
  CHECK(png.find("\r\n\r\n\x89PNG") != std::string::npos);
  CHECK(status(site.get(site.root() + "frame?view=twin")) == 404);
  CHECK(status(site.get(site.root() + "frame?view=difference")) == 404);
  CHECK(site.get(site.root() + "values?view=gpu&width=2").ends_with(R"([[0.0,0.5,1.0],[2.0,"NaN",-1.0]])"));
  for (const char* pixels : {"&x=2", "&x=-1", "&y=1", "&width=3", "&width=0", "&width=4096&height=4096",
                             "&width=2147483647&height=2147483647", "&x=2147483647"})
    CHECK(status(site.get(site.root() + "values?view=gpu" + pixels)) == 400);
}

TEST_CASE("nothing without the token, and no file of the machine") {
  const Site site;
  for (const std::string& path : {std::string("/"), std::string("/main.mjs"), std::string("/frame?view=gpu"),
                                  std::string("/0123456789abcdef/"), site.root() + "../../../etc/passwd",
                                  site.root() + "%2e%2e%2f%2e%2e%2fetc%2fpasswd", site.root() + "/etc/passwd",
                                  site.root() + "style.css/../main.mjs"}) {
    CAPTURE(path);
    CHECK(status(site.get(path)) == 404);
  }
  const Site other;
  CHECK(site.root() != other.root());
}

TEST_CASE("another host's name, or another page's origin, is refused") {
  Site site;
  const auto with_host = [&](const std::string& host) {
    return status(site.ask("GET " + site.root() + " HTTP/1.1\r\n" + host + "\r\n"));
  };
  const std::string port = std::to_string(site.server.port());
  CHECK(with_host("Host: localhost:" + port + "\r\n") == 200);
  CHECK(with_host("Host: [::1]:" + port + "\r\n") == 200);
  CHECK(with_host("Host: evil.example:" + port + "\r\n") == 403);
  CHECK(with_host("Host: 127.0.0.1.evil.example:" + port + "\r\n") == 403);
  CHECK(with_host("Host: 127.0.0.1\r\n") == 403);
  CHECK(with_host("Host: 127.0.0.1:1\r\n") == 403);
  CHECK(with_host("") == 403);
  CHECK(with_host("Host: localhost:" + port + "\r\nHost: evil.example\r\n") == 403);

  CHECK(status(site.get(site.root(), "Origin: http://evil.example\r\n")) == 403);
  CHECK(status(site.get(site.root(), "Sec-Fetch-Site: cross-site\r\n")) == 403);
  CHECK(status(site.post(R"({"view":"twin"})", "")) == 403);
  CHECK(status(site.post(R"({"view":"twin"})", "Origin: http://localhost:1\r\n")) == 403);
  CHECK(status(site.post(R"({"view":"twin"})", "Origin: null\r\n")) == 403);
  CHECK(site.commands.empty());
  CHECK(status(site.post(R"({"view":"twin"})", site.own_origin())) == 204);
  CHECK(site.commands == std::vector<Json>{{{"view", "twin"}}});
  for (const char* nonsense : {"", "[]", "{", "7", "\xff\xfe"})
    CHECK(status(site.post(nonsense, site.own_origin())) == 400);
  CHECK(status(site.ask("DELETE " + site.root() + "command HTTP/1.1\r\nHost: " + site.host() + "\r\n" +
                        site.own_origin() + "\r\n")) == 404);
}

TEST_CASE("a command that is nested too deep is refused, and the server lives on") {
  const Site site;
  const auto nested = [&](size_t depth) {
    return status(site.post("{\"a]\\\"[\":" + std::string(depth - 1, '[') + std::string(depth - 1, ']') + "}",
                            site.own_origin()));
  };
  CHECK(nested(64) == 204);
  CHECK(nested(65) == 400);
  CHECK(nested(100'000) == 400);
  CHECK(nested(500'000) == 400);
  CHECK(status(site.get(site.root())) == 200);
}

TEST_CASE("it listens on this machine's own addresses alone") {
  const Site site;
  CHECK(Client(site.server.port()).connected());
  std::ifstream table("/proc/net/tcp");
  const std::string wanted = fmt::format(":{:04X}", site.server.port());
  int listening = 0;
  for (std::string line; std::getline(table, line);) {
    std::istringstream words(line);
    std::string number, local, remote, state;
    words >> number >> local >> remote >> state;
    if (!local.ends_with(wanted) || state != "0A") continue;
    ++listening;
    CHECK(local.starts_with("0100007F"));  // 127.0.0.1
  }
  CHECK(listening == 1);
}

TEST_CASE("a port that is taken is left to who has it") {
  const Site first;
  const Site second(first.server.port());
  CHECK(second.server.port() != first.server.port());
  CHECK(status(first.get(first.root())) == 200);
  CHECK(status(second.get(second.root())) == 200);
}

TEST_CASE("requests that are too large cost nothing") {
  const Site site;
  const size_t before = resident_bytes();
  {
    // A header of a gigabyte, in one line: it is cut off long before.
    const Client client(site.server.port());
    client.send("GET " + site.root() + " HTTP/1.1\r\nHost: " + site.host() + "\r\nX: ");
    const std::string piece(1 << 20, 'x');
    int sent = 0;
    while (sent < 1024 && client.send(piece)) ++sent;
    CHECK(sent < 64);
  }
  std::string many = "GET " + site.root() + " HTTP/1.1\r\nHost: " + site.host() + "\r\n";
  for (int i = 0; i < 2000; ++i) many += fmt::format("X-{}: y\r\n", i);
  CHECK(status(site.ask(many + "\r\n")) != 200);
  const std::string large(2 << 20, 'x');
  CHECK(status(site.post("{\"view\":\"" + large + "\"}", site.own_origin())) != 204);
  CHECK(resident_bytes() < before + (32 << 20));
  CHECK(status(site.get(site.root())) == 200);
}

TEST_CASE("slow clients are dropped, and keep nobody waiting for ever") {
  WebLimits limits;
  limits.request_seconds = 0.5;
  limits.write_seconds = 0.5;
  limits.connections = 4;
  const Site site(0, limits);
  // More than there are connections: some say nothing, some say a little now and then.
  std::vector<std::unique_ptr<Client>> slow;
  for (int i = 0; i < 12; ++i) slow.push_back(std::make_unique<Client>(site.server.port()));
  std::atomic<bool> enough = false;
  std::thread drip([&] {
    while (!enough) {
      for (size_t i = 0; i < slow.size(); i += 2) slow[i]->send("G");
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
  CHECK(status(site.get(site.root())) == 200);
  for (const auto& client : slow) CHECK(status(client->answer()) != 200);
  enough = true;
  drip.join();
}

TEST_CASE("300 silent clients hold the page for less than one request's time") {
  const Site site;
  std::vector<std::unique_ptr<Client>> silent;
  for (int i = 0; i < 300; ++i) silent.push_back(std::make_unique<Client>(site.server.port()));
  const Stopwatch watch;
  CHECK(status(site.get(site.root())) == 200);
  CHECK(watch.seconds() < 4);
}

TEST_CASE("a reader of events who does not read is dropped") {
  WebLimits limits;
  limits.write_seconds = 0.3;
  limits.listeners = 1;
  Site site(0, limits);
  const Client deaf(site.server.port());
  deaf.send("GET " + site.root() + "events HTTP/1.1\r\nHost: " + site.host() + "\r\n\r\n");
  CHECK(deaf.answer("\n\n").find("data: {") != std::string::npos);
  CHECK(status(site.get(site.root() + "events")) == 503);
  // Its place is free again once it has not taken what there is to say.
  const std::string much(1 << 20, 'x');
  int answered = 503;
  for (int i = 0; i < 10000 && answered == 503; ++i) {
    site.board.update([&](Json& json) { json["state"] = much + std::to_string(i); });
    const Client next(site.server.port());
    next.send("GET " + site.root() + "events HTTP/1.1\r\nHost: " + site.host() + "\r\n\r\n");
    answered = status(next.answer("\r\n\r\n"));
  }
  CHECK(answered == 200);
}
