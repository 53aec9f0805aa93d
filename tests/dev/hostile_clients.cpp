// Clients of the page's server that mean no good.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "host/core/stopwatch.hpp"
#include "host/dev/web_server.hpp"
#include "site.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::dev;
using namespace eyeray::engine::test;

namespace {

// A process may open 1024 files at first, and more on request.
void allow_many_files() {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
}

size_t open_files() {
  using std::filesystem::directory_iterator;
  return size_t(std::distance(directory_iterator("/proc/self/fd"), directory_iterator()));
}

size_t resident_bytes() {
  size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * size_t(::sysconf(_SC_PAGESIZE));
}

}  // namespace

TEST_CASE("requests that are too large are refused, and use little memory") {
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

TEST_CASE("slow clients are dropped, and do not delay others for ever") {
  WebLimits limits;
  limits.request_seconds = 0.5;
  limits.connections = 4;
  const Site site(0, limits);
  // More clients than connections: some send nothing, some send a little now and then.
  const auto slow = clients(site, 12);
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

TEST_CASE("silent clients do not delay others") {
  allow_many_files();
  for (const int count : {300, 1000}) {
    const Site site;
    // A busy machine may take its time; it does not do so ten times in a row.
    double fastest = 1e9;
    for (int i = 0; i < 10 && fastest > 0.5; ++i) {
      const Stopwatch watch;
      const auto silent = clients(site, count);
      CHECK(status(site.get(site.root())) == 200);
      fastest = std::min(fastest, watch.seconds());
    }
    CHECK(fastest < 0.5);
  }
}

TEST_CASE("clients that come and go leave nothing open") {
  const Site site;
  CHECK(status(site.get(site.root())) == 200);
  const size_t before = open_files();
  for (int i = 0; i < 200; ++i) {
    const Client gone(site.server.port());
    if (i % 4 == 1) gone.send("GET / HTTP/1.1\r\nHo");
    if (i % 4 == 2) gone.send("GET " + site.root() + "events HTTP/1.1\r\nHost: " + site.host() + "\r\n\r\n");
    if (i % 4 == 3) gone.send("GET " + site.root() + " HTTP/1.1\r\nHost: " + site.host() + "\r\n\r\n");
  }
  for (const Stopwatch watch; open_files() > before && watch.seconds() < 60;)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK(open_files() <= before);
}

TEST_CASE("a reader of pictures who does not read is dropped") {
  WebLimits limits;
  limits.write_seconds = 1;
  limits.connections = 2;
  Site site(0, limits);
  // More bytes than fit into the sockets' buffers.
  std::minstd_rand random(1);
  std::vector<float> noise(size_t(3) * 2000 * 2000);
  std::generate(noise.begin(), noise.end(), [&] { return float(random() % 1024) / 1024; });
  site.put_picture("twin", 2000, 2000, noise);
  std::vector<std::unique_ptr<Client>> deaf;
  for (int i = 0; i < 3; ++i) {
    deaf.push_back(std::make_unique<Client>(site.server.port()));
    deaf[i]->send("GET " + site.root() + "frame?view=twin HTTP/1.1\r\nHost: " + site.host() + "\r\n\r\n");
    CHECK(deaf[i]->answer("\r\n\r\n").find("image/png") != std::string::npos);
  }
  CHECK(status(site.get(site.root())) == 200);
  const std::string rest = deaf[0]->answer();
  CHECK(rest.size() < 10'000'000);
  const std::string png = site.get(site.root() + "frame?view=twin");
  CHECK(png.size() > 10'000'000);
  CHECK(png.find(fmt::format("Content-Length: {}\r\n", body(png).size())) != std::string::npos);
}

TEST_CASE("a connection has one request") {
  const Site site;
  const std::string get = "GET " + site.root() + " HTTP/1.1\r\nHost: " + site.host() + "\r\n\r\n";
  const std::string post =
      fmt::format("POST {}command HTTP/1.1\r\nHost: {}\r\n{}Content-Length: 2\r\n\r\n{{}}", site.root(),
                  site.host(), site.own_origin());
  const auto alone = body(site.ask(get));
  CHECK(body(site.ask(get + get)) == alone);
  CHECK(body(site.ask(get + post)) == alone);
  CHECK(site.commands.empty());
  CHECK(status(site.ask(post + post)) == 204);
  CHECK(site.commands.size() == 1);
}

TEST_CASE("a request body must use exactly one valid encoding") {
  WebLimits limits;
  limits.request_seconds = 0.5;
  const Site site(0, limits);
  const auto send = [&](const std::string& rest) {
    return status(site.ask("POST " + site.root() + "command HTTP/1.1\r\nHost: " + site.host() + "\r\n" +
                           site.own_origin() + rest));
  };
  const std::string chunked = "Transfer-Encoding: chunked\r\n";
  CHECK(send(chunked + "\r\n1\r\n{\r\n1\r\n}\r\n0\r\n\r\n") == 204);
  CHECK(site.commands.size() == 1);
  for (const char* bad : {"\r\nx\r\n{}\r\n0\r\n\r\n", "\r\n-1\r\n{}\r\n0\r\n\r\n", "\r\n1\r\n{}\r\n0\r\n\r\n",
                          "\r\nffffffffffffffff\r\n{}\r\n0\r\n\r\n",
                          "\r\n10000000000000002\r\n{}\r\n0\r\n\r\n", "\r\n\r\n{}\r\n0\r\n\r\n"}) {
    CAPTURE(bad);
    CHECK(send(chunked + bad) != 204);
  }
  for (const char* bad : {"Content-Length: -2\r\n\r\n{}", "Content-Length: 18446744073709551618\r\n\r\n{}",
                          "Content-Length: 0x2\r\n\r\n{}", "Content-Length: two\r\n\r\n{}"}) {
    CAPTURE(bad);
    CHECK(send(bad) != 204);
  }
  // A body in chunks that never ends.
  const size_t before = resident_bytes();
  {
    const Client client(site.server.port());
    client.send("POST " + site.root() + "command HTTP/1.1\r\nHost: " + site.host() + "\r\n" +
                site.own_origin() + chunked + "\r\n");
    const std::string chunk = "100000\r\n" + std::string(1 << 20, ' ') + "\r\n";
    int sent = 0;
    while (sent < 1024 && client.send(chunk)) ++sent;
    CHECK(sent < 64);
  }
  CHECK(resident_bytes() < before + (32 << 20));
  CHECK(site.commands.size() == 1);
  CHECK(status(site.get(site.root())) == 200);
}

TEST_CASE("the server ends at once, whatever state its clients are in") {
  const Stopwatch watch;
  std::vector<std::unique_ptr<Client>> open;
  {
    const Site site;
    for (const std::string& request :
         {std::string(), std::string("GET / HT"),
          "GET " + site.root() + "events HTTP/1.1\r\nHost: " + site.host() + "\r\n\r\n",
          "POST " + site.root() + "command HTTP/1.1\r\nHost: " + site.host() +
              "\r\nContent-Length: 9\r\n\r\n{"}) {
      open.push_back(std::make_unique<Client>(site.server.port()));
      open.back()->send(request);
    }
    CHECK(status(site.get(site.root())) == 200);
  }
  for (const auto& client : open) client->answer();
  CHECK(watch.seconds() < 4);  // less time than any client is given
}

TEST_CASE("a reader of events who does not read is dropped") {
  WebLimits limits;
  limits.write_seconds = 1;
  limits.listeners = 1;
  Site site(0, limits);
  const Client deaf(site.server.port());
  deaf.send("GET " + site.root() + "events HTTP/1.1\r\nHost: " + site.host() + "\r\n\r\n");
  CHECK(deaf.answer("\n\n").find("data: {") != std::string::npos);
  CHECK(status(site.get(site.root() + "events")) == 503);
  // The slot of the client that does not read is free again once the waiting text could not be sent to it.
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
