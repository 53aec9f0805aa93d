#include "host/dev/web_server.hpp"

#include <sys/random.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <span>
#include <thread>
#include <vector>

#include "host/core/embedded_file.hpp"
#include "host/core/error.hpp"
#include "host/core/json_depth.hpp"
#include "host/core/stopwatch.hpp"
#include "host/dev/guarded_server.hpp"
#include "host/image/image_file.hpp"

namespace eyeray::dev {

std::span<const EmbeddedFile> page_files();  // dev/web

namespace {

using httplib::Request;
using httplib::Response;

constexpr int ports_to_try = 32;
constexpr int most_values = 4096;     // pixels of one answer
constexpr float not_compared = 0.2f;  // the grey of pixels whose difference is not known yet
constexpr double seconds_between_signs_of_life = 10;

constexpr std::array<std::pair<const char*, const char*>, 6> headers{{
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
     "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cache-Control", "no-store"},
}};

std::string random_token() {
  std::array<unsigned char, 16> bytes;
  if (::getrandom(bytes.data(), bytes.size(), 0) != ssize_t(bytes.size()))
    throw Error(ExitCode::file_io, "no random numbers to be had: getrandom: {}", strerror(errno));
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

void refuse(Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(why + "\n", "text/plain; charset=utf-8");
}

// As HTTP says it.
const char* content_type(std::string_view file) {
  return file.ends_with(".html")  ? "text/html; charset=utf-8"
         : file.ends_with(".css") ? "text/css; charset=utf-8"
         : file.ends_with(".mjs") ? "text/javascript; charset=utf-8"
                                  : "image/svg+xml";
}

constexpr const char* difference = "difference";

std::optional<Board::Picture> values_of(const Board& board, const std::string& view) {
  return view == difference ? board.difference() : board.picture(view);
}

// Data in false colour, or colours brightened by so many stops.
image::Image for_people(Board::Picture picture, double stops) {
  if (picture.shown_as) return image::false_color(picture.image, *picture.shown_as);
  const float factor = float(std::exp2(stops));
  for (float& sample : picture.image.samples()) sample *= factor;
  return std::move(picture.image);
}

double number(const Request& request, const char* name, double otherwise) {
  const std::string text = request.get_param_value(name);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end || !std::isfinite(value) ? otherwise : value;
}

// NaN and infinities are words, which JSON has no numbers for.
Json as_json(float value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "NaN" : value > 0 ? "inf" : "-inf";
}

}  // namespace

struct WebServer::Servers {
  Servers(Board& shown_board, Command obey, const WebLimits& most)
      : board(shown_board), command(std::move(obey)), limits(most), token(random_token()) {}

  void set_up(httplib::Server& server);
  bool bind(int port);
  bool is_allowed(const Request& request, Response& response) const;
  void picture(const Request& request, Response& response) const;
  void values(const Request& request, Response& response) const;
  void events(Response& response);

  Board& board;
  Command command;
  WebLimits limits;
  std::string token;
  int port = 0;
  std::atomic<int> listeners = 0;
  std::vector<std::unique_ptr<GuardedServer>> servers;
  std::vector<std::thread> threads;
};

bool WebServer::Servers::is_allowed(const Request& request, Response& response) const {
  const std::string host = request.get_header_value("Host");
  bool known = false;
  for (const char* name : {"127.0.0.1", "localhost", "[::1]"})
    known = known || host == fmt::format("{}:{}", name, port);
  if (!known || request.get_header_value_count("Host") != 1) {
    refuse(response, 403, "This is not the host that you asked for.");
    return false;
  }
  // Browsers name the page that sends what could change something, and may do so for the rest.
  const std::string origin = request.get_header_value("Origin");
  const bool must_say = request.method != "GET";
  if (origin != "http://" + host && (must_say || !origin.empty())) {
    refuse(response, 403, "Only eyeray's own page may ask for this.");
    return false;
  }
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  if (!site.empty() && site != "same-origin" && site != "none") {
    refuse(response, 403, "Only eyeray's own page may ask for this.");
    return false;
  }
  return true;
}

void WebServer::Servers::picture(const Request& request, Response& response) const {
  std::optional<Board::Picture> found = values_of(board, request.get_param_value("view"));
  if (!found) return refuse(response, 404, "There is no such picture yet.");
  image::Image image = for_people(std::move(*found), number(request, "exposure", 0));
  if (request.get_param_value("view") == difference)
    for (float& sample : image.samples())
      if (std::isnan(sample)) sample = not_compared;
  response.set_content(image::encode_png(image), "image/png");
}

void WebServer::Servers::values(const Request& request, Response& response) const {
  const std::optional<Board::Picture> found = values_of(board, request.get_param_value("view"));
  if (!found) return refuse(response, 404, "There is no such picture yet.");
  const image::Image& image = found->image;
  const int x = int(number(request, "x", 0)), y = int(number(request, "y", 0));
  const int width = int(number(request, "width", 1)), height = int(number(request, "height", 1));
  if (x < 0 || y < 0 || width < 1 || height < 1 || width > most_values || height > most_values / width ||
      x > image.width() - width || y > image.height() - height)
    return refuse(response, 400, "These are not pixels of the picture, or more than 4096.");
  Json rows = Json::array();
  for (int j = y; j < y + height; ++j) {
    for (int i = x; i < x + width; ++i) {
      Json pixel = Json::array();
      for (int c = 0; c < image.channels(); ++c) pixel.push_back(as_json(image.pixel(i, j)[c]));
      rows.push_back(std::move(pixel));
    }
  }
  response.set_content(rows.dump(), "application/json");
}

// Server-sent events: the status now and whenever it changes.
void WebServer::Servers::events(Response& response) {
  if (++listeners > limits.listeners) {
    --listeners;
    return refuse(response, 503, "Too many pages are open.");
  }
  const auto listening = std::shared_ptr<void>(nullptr, [this](void*) { --listeners; });
  response.set_chunked_content_provider(
      "text/event-stream", [this, listening, seen = uint64_t{0}](size_t, httplib::DataSink& sink) mutable {
        const std::optional<std::string> status = board.next_status(seen, seconds_between_signs_of_life);
        if (board.closed()) {
          sink.done();
          return true;
        }
        const std::string text = status ? "data: " + *status + "\n\n" : ":\n\n";
        return sink.write(text.data(), text.size());
      });
}

void WebServer::Servers::set_up(httplib::Server& server) {
  // Two programs may not share a port, which is the library's default.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_pre_routing_handler([this](const Request& request, Response& response) {
    for (const auto& [name, value] : headers) response.set_header(name, value);
    return is_allowed(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                         : httplib::Server::HandlerResponse::Handled;
  });
  server.set_exception_handler([](const Request&, Response& response, std::exception_ptr) {
    refuse(response, 400, "This request makes no sense.");
  });
  const std::string root = "/" + token + "/";
  for (const EmbeddedFile& file : page_files()) {
    server.Get(root + (file.name == "index.html" ? "" : std::string(file.name)),
               [&file](const Request&, Response& response) {
                 response.set_content(file.text.data(), file.text.size(), content_type(file.name));
               });
  }
  server.Get(root + "events", [this](const Request&, Response& response) { events(response); });
  server.Get(root + "frame",
             [this](const Request& request, Response& response) { picture(request, response); });
  server.Get(root + "values",
             [this](const Request& request, Response& response) { values(request, response); });
  server.Get(root + "probe", [this](const Request&, Response& response) {
    response.set_content(board.probe().dump(-1, ' ', false, Json::error_handler_t::replace),
                         "application/json");
  });
  server.Post(root + "command", [this](const Request& request, Response& response) {
    const Json json = Json::parse(unless_too_deep(request.body), nullptr, false);
    if (!json.is_object())
      return refuse(response, 400, "A command is a JSON object, nested at most 64 deep.");
    command(json);
    response.status = 204;
  });
}

// Whether both addresses, or 127.0.0.1 on a machine without IPv6, take the port.
bool WebServer::Servers::bind(int wanted) {
  servers.clear();
  port = wanted;
  for (const char* address : {"127.0.0.1", "::1"}) {
    auto server = std::make_unique<GuardedServer>(limits);
    set_up(*server);
    errno = 0;
    const bool bound =
        port != 0 ? server->bind_to_port(address, port) : (port = server->bind_to_any_port(address)) > 0;
    if (bound)
      servers.push_back(std::move(server));
    else if (servers.empty() || errno == EADDRINUSE)
      return false;
  }
  return true;
}

WebServer::WebServer(Board& board, Command command, int port, WebLimits limits)
    : servers_(std::make_unique<Servers>(board, std::move(command), limits)) {
  bool bound = servers_->bind(port);
  for (int i = 1; !bound && i < ports_to_try && port + i < 65536; ++i) bound = servers_->bind(port + i);
  if (!bound && !servers_->bind(0))
    throw Error(ExitCode::file_io, "no port of 127.0.0.1 can be had: {}", strerror(errno));
  for (const auto& server : servers_->servers)
    servers_->threads.emplace_back([&server] { server->listen_after_bind(); });
}

WebServer::~WebServer() {
  servers_->board.close();
  for (const auto& server : servers_->servers) {
    // One that has not begun to listen would not hear of it.
    for (const Stopwatch watch; !server->is_running() && watch.seconds() < 1;) std::this_thread::yield();
    server->stop();
  }
  for (std::thread& thread : servers_->threads) thread.join();
}

int WebServer::port() const {
  return servers_->port;
}

std::string WebServer::address() const {
  return fmt::format("http://127.0.0.1:{}/{}/", port(), servers_->token);
}

}  // namespace eyeray::dev
