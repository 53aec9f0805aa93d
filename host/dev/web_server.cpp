#include "host/dev/web_server.hpp"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <thread>

#include "host/core/embedded_file.hpp"
#include "host/core/error.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/json_depth.hpp"
#include "host/image/image_file.hpp"
#include "host/image/tone.hpp"

namespace eyeray::engine::dev {

std::span<const EmbeddedFile> page_files();  // dev/web

namespace {

constexpr int most_values = 4096;     // pixels of one answer
constexpr float not_compared = 0.2f;  // the grey of pixels whose difference is not known yet

std::string random_token() {
  std::array<unsigned char, 16> bytes;
  if (::getrandom(bytes.data(), bytes.size(), 0) != ssize_t(bytes.size()))
    throw Error(ExitCode::file_io, "cannot get random numbers: getrandom: {}", strerror(errno));
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

Answer refusal(int status, const std::string& why) {
  return {status, "text/plain; charset=utf-8", why + "\n"};
}

// The type of a file for HTTP.
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

// Data in false colour, or colours in the scene's tone, brightened by so many stops.
image::Image for_people(Board::Picture picture, double stops) {
  if (picture.shown_as) return image::false_color(picture.image, *picture.shown_as);
  picture.tone.exposure += stops;
  return image::toned(picture.image, picture.tone);
}

double number(Request& request, const char* name, double otherwise) {
  const std::string& text = request.query[name];
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end || !std::isfinite(value) ? otherwise : value;
}

// NaN and infinities become strings, since JSON has no such numbers.
Json as_json(float value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "NaN" : value > 0 ? "inf" : "-inf";
}

Answer picture(const Board& board, Request& request) {
  const std::string& view = request.query["view"];
  std::optional<Board::Picture> found = values_of(board, view);
  if (!found) return refusal(404, "There is no such picture yet.");
  image::Image image = for_people(std::move(*found), number(request, "exposure", 0));
  if (view == difference)
    for (float& sample : image.samples())
      if (std::isnan(sample)) sample = not_compared;
  return {200, "image/png", image::encode_png(image)};
}

Answer values(const Board& board, Request& request) {
  const std::optional<Board::Picture> found = values_of(board, request.query["view"]);
  if (!found) return refusal(404, "There is no such picture yet.");
  const image::Image& image = found->image;
  const int x = int(number(request, "x", 0)), y = int(number(request, "y", 0));
  const int width = int(number(request, "width", 1)), height = int(number(request, "height", 1));
  if (x < 0 || y < 0 || width < 1 || height < 1 || width > most_values || height > most_values / width ||
      x > image.width() - width || y > image.height() - height)
    return refusal(400, "The rectangle must lie within the picture and have 1 to 4096 pixels.");
  Json rows = Json::array();
  for (int j = y; j < y + height; ++j) {
    for (int i = x; i < x + width; ++i) {
      Json pixel = Json::array();
      for (int c = 0; c < image.channels(); ++c) pixel.push_back(as_json(image.pixel(i, j)[c]));
      rows.push_back(std::move(pixel));
    }
  }
  return {200, "application/json", json_text(rows)};
}

}  // namespace

struct WebServer::Site {
  Site(Board& shown_board, Command obey, int port, const WebLimits& limits)
      : board(shown_board),
        command(std::move(obey)),
        server(port, [this](Request request) { return answer(request); }, limits) {}
  ~Site() {
    board.close();
    teller.join();
  }

  Answer answer(Request& request) const;
  std::optional<Answer> refused(Request& request) const;
  void tell();

  Board& board;
  Command command;
  std::string token = random_token();
  HttpServer server;
  std::thread teller{[this] { tell(); }};
};

// The answer to a request that is not from the page, nor typed by the user.
std::optional<Answer> WebServer::Site::refused(Request& request) const {
  const std::string& host = request.header["host"];
  bool known = false;
  for (const char* name : {"127.0.0.1", "localhost", "[::1]"})
    known = known || host == fmt::format("{}:{}", name, request.port);
  if (!known) return refusal(403, "This is not the host that you asked for.");
  // Browsers name the page that a request comes from if the request may change something; for other requests
  // they may leave it out.
  const std::string &origin = request.header["origin"], &site = request.header["sec-fetch-site"];
  const bool must_say = request.method != "GET" && request.method != "HEAD";
  if ((origin != "http://" + host && (must_say || !origin.empty())) ||
      (!site.empty() && site != "same-origin" && site != "none"))
    return refusal(403, "Only eyeray's own page may ask for this.");
  return std::nullopt;
}

Answer WebServer::Site::answer(Request& request) const {
  if (std::optional<Answer> answer = refused(request)) return *answer;
  const std::string root = "/" + token + "/";
  const Answer nothing = refusal(404, "There is nothing here.");
  if (!request.path.starts_with(root)) return nothing;
  const std::string name = request.path.substr(root.size());
  if (request.method == "POST" && name == "command") {
    const Json json = Json::parse(unless_too_deep(request.body), nullptr, false);
    if (!json.is_object()) return refusal(400, "A command is a JSON object, nested at most 64 deep.");
    command(json);
    return {204, "", ""};
  }
  if (request.method != "GET" && request.method != "HEAD") return nothing;
  if (name == "events") return {200, "text/event-stream", "", true};
  if (name == "frame") return picture(board, request);
  if (name == "values") return values(board, request);
  if (name == "probe") return {200, "application/json", json_text(board.probe())};
  for (const EmbeddedFile& file : page_files())
    if (name == (file.name == "index.html" ? "" : file.name))
      return {200, content_type(file.name), std::string(file.text)};
  return nothing;
}

// Sends the status now and whenever it changes.
void WebServer::Site::tell() {
  for (uint64_t seen = 0; !board.closed();)
    if (const auto status = board.next_status(seen, 3600)) server.publish("data: " + *status + "\n\n");
}

WebServer::WebServer(Board& board, Command command, int port, WebLimits limits)
    : site_(std::make_unique<Site>(board, std::move(command), port, limits)) {}

WebServer::~WebServer() = default;

int WebServer::port() const {
  return site_->server.port();
}

std::string WebServer::address() const {
  return fmt::format("http://127.0.0.1:{}/{}/", port(), site_->token);
}

}  // namespace eyeray::engine::dev
