// The page's server: its answers, and its refusals of pages of other origins.
#include "host/dev/web_server.hpp"

#include <fstream>
#include <thread>

#include "host/core/stopwatch.hpp"
#include "site.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::dev;
using namespace eyeray::engine::test;

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

TEST_CASE("a frame has its picture's tone, and the stops of the request more") {
  Site site;
  const auto put = [&](const char* view, const Json& tone) {
    const std::vector<float> grey(3, 0.25f);
    Message rows{{{"view", view},
                  {"width", 1},
                  {"height", 1},
                  {"row", 0},
                  {"rows", 1},
                  {"stride", 1},
                  {"channels", 3}},
                 std::string(reinterpret_cast<const char*>(grey.data()), 12)};
    if (!tone.is_null()) rows.json["tone"] = tone;
    site.board.put_rows(rows);
  };
  put("gpu", nullptr);
  put("twin", {{"exposure", 1}, {"curve", 0}, {"white_balance", 0}});
  put("reference", {{"exposure", 1}, {"curve", int(image::ToneCurve::filmic)}, {"white_balance", 0}});
  const auto frame = [&](const std::string& query) {
    const std::string answer = site.get(site.root() + "frame?view=" + query);
    return answer.substr(answer.find("\x89PNG"));
  };
  CHECK(frame("twin") == frame("gpu&exposure=1"));
  CHECK(frame("twin&exposure=-1") == frame("gpu"));
  CHECK(frame("reference") != frame("twin"));
}

TEST_CASE("the server serves nothing without the token, and no file of the machine") {
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
  for (const std::string& host : {std::string(), "Host: localhost:" + port + "\r\nHost: evil.example\r\n"}) {
    const int refused = with_host(host);
    CAPTURE(refused);
    CHECK((refused == 403 || refused == 400));  // libmicrohttpd 1.0 knows that this is no HTTP
  }

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

TEST_CASE("the server listens only on this machine's own addresses") {
  const Site site;
  CHECK(Client(site.server.port()).connected());
  const std::string wanted = fmt::format(":{:04X}", site.server.port());
  const std::pair<const char*, const char*> loopbacks[] = {
      {"/proc/net/tcp", "0100007F"}, {"/proc/net/tcp6", "00000000000000000000000001000000"}};
  for (const auto& loopback : loopbacks) {
    const std::string address = loopback.second;
    std::ifstream table(loopback.first);
    if (!table) continue;  // a machine without IPv6
    int listening = 0;
    for (std::string line; std::getline(table, line);) {
      std::istringstream words(line);
      std::string number, local, remote, state;
      words >> number >> local >> remote >> state;
      if (!local.ends_with(wanted) || state != "0A") continue;
      ++listening;
      CHECK(local == address + wanted);
    }
    CHECK(listening == 1);
  }
}

TEST_CASE("a port in use stays with its owner") {
  const Site first;
  const Site second(first.server.port());
  CHECK(second.server.port() != first.server.port());
  CHECK(status(first.get(first.root())) == 200);
  CHECK(status(second.get(second.root())) == 200);
}

TEST_CASE("a closed page frees its connection for the next page") {
  WebLimits limits;
  limits.listeners = 1;
  Site site(0, limits);
  site.board.update([](Json& json) { json["state"] = "done"; });
  const Stopwatch watch;
  for (int i = 0; i < 5; ++i) {
    int answered = 503;
    while (answered == 503 && watch.seconds() < 60) {
      const Client page(site.server.port());
      page.send("GET " + site.root() + "events HTTP/1.1\r\nHost: " + site.host() + "\r\n\r\n");
      answered = status(page.answer("\r\n\r\n"));
    }
    CHECK(answered == 200);
  }
  CHECK(watch.seconds() < 8);  // not at the next sign of life, which is sent every ten seconds
}

TEST_CASE("all pages get a status of any length") {
  Site site;
  const auto pages = clients(site, 3);
  for (const auto& page : pages)
    page->send("GET " + site.root() + "events HTTP/1.1\r\nHost: " + site.host() + "\r\n\r\n");
  site.board.update([](Json& json) { json["state"] = std::string(300'000, 'x') + "end"; });
  for (const auto& page : pages) CHECK(page->answer("end\"}\n\n\r\n").find("xxxend\"}") != std::string::npos);
  site.board.update([](Json& json) { json["state"] = "next"; });
  for (const auto& page : pages) CHECK(page->answer("\n\n").find("\"state\":\"next\"}") != std::string::npos);
}

TEST_CASE("a slow request does not delay others") {
  Site site;
  std::mutex busy;
  site.obey = [&] { const std::lock_guard lock(busy); };
  std::thread slow;
  {
    const std::lock_guard lock(busy);
    slow = std::thread([&] { CHECK(status(site.post("{}", site.own_origin())) == 204); });
    CHECK(status(site.get(site.root())) == 200);
    CHECK(site.commands.empty());
  }
  slow.join();
  CHECK(site.commands.size() == 1);
}

TEST_CASE("HEAD has the header of GET, and no body") {
  const Site site;
  for (const std::string name : {"", "main.mjs", "frame?view=gpu", "values?view=gpu", "probe"}) {
    CAPTURE(name);
    const std::string request = site.root() + name + " HTTP/1.1\r\nHost: " + site.host() + "\r\n\r\n";
    const std::string whole = site.ask("GET " + request), head = site.ask("HEAD " + request);
    CHECK(status(head) == 200);
    CHECK(body(head).empty());
    CHECK(head.find(fmt::format("Content-Length: {}\r\n", body(whole).size())) != std::string::npos);
  }
}
