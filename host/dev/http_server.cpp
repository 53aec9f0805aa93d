#include "host/dev/http_server.hpp"

#include <microhttpd.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <list>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "host/core/error.hpp"
#include "host/core/stopwatch.hpp"

namespace eyeray::engine::dev {
namespace {

constexpr int ports_to_try = 32;
constexpr int most_milliseconds = 50;  // between two checks of the time limits
constexpr double seconds_between_signs_of_life = 10;
constexpr size_t block_bytes = 64 << 10;

constexpr std::pair<const char*, const char*> fixed_headers[] = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
     "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cache-Control", "no-store"},
    {"Connection", "close"},  // one request a connection
};

// A socket that listens on this machine's address of the family, or -1 with errno.
int listening_socket(int family, int port) {
  const int socket = ::socket(family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return -1;
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in v4{};
  v4.sin_family = AF_INET;
  v4.sin_port = htons(uint16_t(port));
  v4.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  sockaddr_in6 v6{};
  v6.sin6_family = AF_INET6;
  v6.sin6_port = v4.sin_port;
  v6.sin6_addr = in6addr_loopback;
  const bool listens =
      (family == AF_INET ? ::bind(socket, reinterpret_cast<const sockaddr*>(&v4), sizeof v4)
                         : ::bind(socket, reinterpret_cast<const sockaddr*>(&v6), sizeof v6)) == 0 &&
      ::listen(socket, SOMAXCONN) == 0;
  if (listens) return socket;
  const int reason = errno;
  ::close(socket);
  errno = reason;
  return -1;
}

int port_of(int socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

using Fields = std::map<std::string, std::string>;

MHD_Result add_field(void* fields, MHD_ValueKind kind, const char* name, const char* value) {
  std::string key = name;
  if (kind == MHD_HEADER_KIND)
    for (char& c : key)
      if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  const auto [field, is_new] = static_cast<Fields*>(fields)->emplace(key, value ? value : "");
  if (!is_new) field->second.append(", ").append(value ? value : "");
  return MHD_YES;
}

}  // namespace

class HttpServer::Loop {
 public:
  Loop(int port, Handler handler, const WebLimits& limits);
  ~Loop();

  int port() const { return port_; }
  void publish(std::string text);

 private:
  // A connection, from the time that it is accepted until it is closed. It has one request.
  struct Client {
    enum class State { asks, waits, receives_events, dropped };

    Client(Loop& its_loop, MHD_Connection* its_connection) : loop(its_loop), connection(its_connection) {}

    Loop& loop;
    MHD_Connection* connection;
    State state = State::asks;
    bool suspended = false;  // whether the library has suspended the connection: there is nothing to send
    Stopwatch watch;         // since it was accepted, or since its last event
    Request request;
    Answer answer;
    std::atomic<bool> has_answer = false;
    std::string unsent;   // the rest of the last event
    uint64_t number = 0;  // the number of the last event
    std::jthread handler;

    int socket() const;
    void drop();
    void suspend();
    bool has_gone() const;
    bool has_something_to_send();
    MHD_Result take(const char* path, const char* method, const char* data, size_t* size);
    MHD_Result send();
    ssize_t send_event(char* to, size_t most);
  };

  bool listen(int port);
  void start_daemon(int socket);
  void notice(MHD_Connection* connection, void** client, MHD_ConnectionNotificationCode code);
  void run();
  void step();
  void wake() { ::eventfd_write(wake_, 1); }

  const Handler handler_;
  const WebLimits limits_;
  const int wake_;
  int port_ = 0;
  std::vector<MHD_Daemon*> daemons_;
  std::list<Client> clients_;  // the oldest first
  bool has_closed_ = false;    // a connection has closed since the daemons last ran
  std::mutex event_mutex_;
  std::string event_;
  uint64_t event_number_ = 0;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

// ---- A client ----

int HttpServer::Loop::Client::socket() const {
  return MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd;
}

// The library then finds that the socket has ended, and closes it.
void HttpServer::Loop::Client::drop() {
  state = State::dropped;
  ::shutdown(socket(), SHUT_RDWR);
}

// True if a client that receives events has closed its connection: the library does not notice that while the
// connection is suspended.
bool HttpServer::Loop::Client::has_gone() const {
  char next;
  return state == State::receives_events && ::recv(socket(), &next, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
}

void HttpServer::Loop::Client::suspend() {
  MHD_suspend_connection(connection);
  suspended = true;
}

bool HttpServer::Loop::Client::has_something_to_send() {
  if (loop.ends_ || state == State::dropped) return true;
  if (state != State::receives_events) return has_answer;
  if (!unsent.empty()) return true;
  const std::lock_guard lock(loop.event_mutex_);
  if (number != loop.event_number_)
    unsent = loop.event_;
  else if (watch.seconds() > seconds_between_signs_of_life)
    unsent = ":\n\n";
  number = loop.event_number_;
  return !unsent.empty();
}

// The library calls take() when the header has arrived, for each part of the body, at the end of the request,
// and when the answer is ready.
MHD_Result HttpServer::Loop::Client::take(const char* path, const char* method, const char* data,
                                          size_t* size) {
  if (state == State::dropped || loop.ends_) return MHD_NO;
  if (has_answer) return send();
  if (request.method.empty()) {
    request = {loop.port_, method, path, {}, {}, {}};
    MHD_get_connection_values(connection, MHD_HEADER_KIND, add_field, &request.header);
    MHD_get_connection_values(connection, MHD_GET_ARGUMENT_KIND, add_field, &request.query);
    return MHD_YES;
  }
  if (*size > 0) {
    if (request.body.size() + *size > loop.limits_.body_bytes) return MHD_NO;
    request.body.append(data, std::exchange(*size, 0));
    return MHD_YES;
  }
  state = State::waits;
  suspend();
  handler = std::jthread([this] {
    try {
      answer = loop.handler_(std::move(request));
    } catch (const std::exception&) {
      answer = {400, "text/plain; charset=utf-8", "This request is malformed.\n"};
    }
    has_answer = true;
    loop.wake();
  });
  return MHD_YES;
}

MHD_Result HttpServer::Loop::Client::send() {
  const auto receives = [](const Client& client) { return client.state == State::receives_events; };
  if (answer.events &&
      std::count_if(loop.clients_.begin(), loop.clients_.end(), receives) >= loop.limits_.listeners)
    answer = {503, "text/plain; charset=utf-8", "Too many pages are open.\n"};
  MHD_Response* response;
  if (answer.events) {
    state = State::receives_events;
    response = MHD_create_response_from_callback(
        MHD_SIZE_UNKNOWN, block_bytes,
        [](void* client, uint64_t, char* to, size_t most) {
          return static_cast<Client*>(client)->send_event(to, most);
        },
        this, nullptr);
  } else {
    response =
        MHD_create_response_from_buffer(answer.body.size(), answer.body.data(), MHD_RESPMEM_PERSISTENT);
  }
  if (!response) return MHD_NO;
  for (const auto& [name, value] : fixed_headers) MHD_add_response_header(response, name, value);
  if (!answer.type.empty())
    MHD_add_response_header(response, MHD_HTTP_HEADER_CONTENT_TYPE, answer.type.c_str());
  const MHD_Result result = MHD_queue_response(connection, unsigned(answer.status), response);
  MHD_destroy_response(response);
  return result;
}

ssize_t HttpServer::Loop::Client::send_event(char* to, size_t most) {
  if (loop.ends_) return MHD_CONTENT_READER_END_OF_STREAM;
  if (state == State::dropped) return MHD_CONTENT_READER_END_WITH_ERROR;
  if (!has_something_to_send()) {
    suspend();
    return 0;
  }
  const size_t count = unsent.copy(to, most);
  unsent.erase(0, count);
  watch = {};
  return ssize_t(count);
}

// ---- All clients ----

HttpServer::Loop::Loop(int port, Handler handler, const WebLimits& limits)
    : handler_(std::move(handler)), limits_(limits), wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (wake_ < 0) throw Error(ExitCode::file_io, "cannot make an eventfd: {}", strerror(errno));
  bool listens = listen(port);
  for (int i = 1; !listens && i < ports_to_try && port + i < 65536; ++i) listens = listen(port + i);
  if (!listens && !listen(0))
    throw Error(ExitCode::file_io, "no port of 127.0.0.1 is available: {}", strerror(errno));
  thread_ = std::thread([this] { run(); });
}

HttpServer::Loop::~Loop() {
  ends_ = true;
  wake();
  thread_.join();
  ::close(wake_);
}

void HttpServer::Loop::publish(std::string text) {
  {
    const std::lock_guard lock(event_mutex_);
    event_ = std::move(text);
    ++event_number_;
  }
  wake();
}

// Listens on `port`. True if it is free on both addresses, or on 127.0.0.1 on a machine without IPv6; else
// errno has the reason.
bool HttpServer::Loop::listen(int port) {
  std::vector<int> sockets;
  for (const int family : {AF_INET, AF_INET6}) {
    const int socket = listening_socket(family, port);
    if (socket >= 0) {
      sockets.push_back(socket);
      port = port_of(socket);
    } else if (sockets.empty() || errno == EADDRINUSE) {
      for (const int other : sockets) ::close(other);
      return false;
    }
  }
  port_ = port;
  for (const int socket : sockets) start_daemon(socket);
  return true;
}

void HttpServer::Loop::start_daemon(int socket) {
  const auto notice = [](void* loop, MHD_Connection* connection, void** client,
                         MHD_ConnectionNotificationCode code) {
    static_cast<Loop*>(loop)->notice(connection, client, code);
  };
  const auto take = [](void*, MHD_Connection* connection, const char* path, const char* method, const char*,
                       const char* data, size_t* size, void**) {
    const auto* info = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
    return static_cast<Client*>(info->socket_context)->take(path, method, data, size);
  };
  MHD_Daemon* daemon =
      MHD_start_daemon(MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME, 0, nullptr, nullptr, +take, nullptr,  //
                       MHD_OPTION_LISTEN_SOCKET, socket,                                               //
                       MHD_OPTION_NOTIFY_CONNECTION, +notice, this,                                    //
                       MHD_OPTION_CONNECTION_LIMIT, limits_.connections + 1,                           //
                       MHD_OPTION_CONNECTION_MEMORY_LIMIT, limits_.header_bytes,                       //
                       MHD_OPTION_CONNECTION_TIMEOUT, limits_.write_seconds,                           //
                       MHD_OPTION_END);
  if (!daemon) throw Error(ExitCode::file_io, "cannot start the web server: {}", strerror(errno));
  daemons_.push_back(daemon);
}

// The library calls notice() for each connection that it has accepted or closed.
void HttpServer::Loop::notice(MHD_Connection* connection, void** context,
                              MHD_ConnectionNotificationCode code) {
  if (code == MHD_CONNECTION_NOTIFY_CLOSED) {
    clients_.remove_if([&](const Client& client) { return &client == *context; });
    has_closed_ = true;
    return;
  }
  *context = &clients_.emplace_back(*this, connection);
  if (clients_.size() <= limits_.connections) return;
  const auto oldest = std::find_if(clients_.begin(), clients_.end(),
                                   [](const Client& client) { return client.state == Client::State::asks; });
  if (oldest != std::prev(clients_.end())) oldest->drop();
}

void HttpServer::Loop::run() {
  std::vector<pollfd> polled{{wake_, POLLIN, 0}};
  for (MHD_Daemon* daemon : daemons_)
    polled.push_back({MHD_get_daemon_info(daemon, MHD_DAEMON_INFO_EPOLL_FD)->epoll_fd, POLLIN, 0});
  while (!ends_) {
    // After a connection has ended, the library accepts another one only if it is run once more.
    MHD_UNSIGNED_LONG_LONG wait = std::exchange(has_closed_, false) ? 0
                                  : clients_.empty()                ? 60'000
                                                                    : most_milliseconds;
    for (MHD_Daemon* daemon : daemons_)
      if (MHD_UNSIGNED_LONG_LONG own; MHD_get_timeout(daemon, &own) == MHD_YES) wait = std::min(wait, own);
    ::poll(polled.data(), polled.size(), int(wait));
    eventfd_t count;
    ::eventfd_read(wake_, &count);
    step();
    for (MHD_Daemon* daemon : daemons_) MHD_run(daemon);
  }
  step();
  for (MHD_Daemon* daemon : daemons_) MHD_stop_daemon(daemon);
}

void HttpServer::Loop::step() {
  for (Client& client : clients_) {
    const bool late = client.state == Client::State::asks && client.watch.seconds() > limits_.request_seconds;
    if (late || client.has_gone()) client.drop();
    if (client.suspended && client.has_something_to_send()) {
      client.suspended = false;
      MHD_resume_connection(client.connection);
    }
  }
}

HttpServer::HttpServer(int port, Handler handler, const WebLimits& limits)
    : loop_(std::make_unique<Loop>(port, std::move(handler), limits)) {}

HttpServer::~HttpServer() = default;

int HttpServer::port() const {
  return loop_->port();
}

void HttpServer::publish(std::string text) {
  loop_->publish(std::move(text));
}

}  // namespace eyeray::engine::dev
