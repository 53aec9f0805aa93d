#include "host/dev/supervisor.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "host/core/escaped_text.hpp"
#include "host/core/readable.hpp"
#include "host/core/termination.hpp"
#include "host/film/channel.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::dev {
namespace {

constexpr double seconds_between_looks = 1;
constexpr double patience = 5;  // beyond the worker's own time-out
// The time for which outdated work may go on: the worker may be in a driver's compiler, or wait for a device.
constexpr double grace = 1.5;

// All shaders below a folder: the files that might be read, if the files read are unknown.
std::set<fs::path> shaders_in(const fs::path& folder) {
  std::set<fs::path> found;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path ending = entry->path().extension();
    if (ending == ".glsl" || ending == ".h") found.insert(entry->path());
  }
  return found;
}

std::set<fs::path> paths(const Json& names) {
  std::set<fs::path> set;
  for (const Json& name : names)
    if (name.is_string()) set.insert(name.get<std::string>());
  return set;
}

}  // namespace

Supervisor::Supervisor(SupervisorOptions options, Report report)
    : options_(std::move(options)),
      report_(std::move(report)),
      worker_(options_.worker),
      view_(options_.view),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (wake_ < 0) throw Error(ExitCode::file_io, "cannot make an eventfd: {}", strerror(errno));
}

void Supervisor::begin() {
  if (options_.port && !options_.once) {
    const auto command = [this](const Json& json) {
      const std::lock_guard lock(commands_mutex_);
      commands_.push_back(json);
      ::eventfd_write(wake_, 1);
    };
    server_.emplace(board_, command, *options_.port);
    report_({{"event", "listening"},
             {"address", server_->address()},
             {"port", server_->port()},
             {"wanted", *options_.port}});
  }
  board_.update([&](Json& status) {
    Json aovs = Json::array();
    for (const film::ChannelType& type : film::channel_types()) aovs.push_back(type.name);
    status = {
        {"scene", options_.scene.string()}, {"aovs", std::move(aovs)}, {"state", "starting"}, {"view", view_},
        {"pictures", Json::object()},       {"failure", nullptr},      {"stale", false}};
  });
  begin_revision();
}

void Supervisor::step() {
  wait();
  take_messages();
  take_changes();
  take_commands();
  send_probe();
}

ExitCode Supervisor::run() {
  begin();
  while (!interrupted()) {
    step();
    // If the machine has no device, no saved file can help: end.
    if (result_ && (options_.once || (result_ == ExitCode::no_device && !seen_any_))) return *result_;
  }
  return ExitCode::interrupted;
}

void Supervisor::wait() {
  std::vector<pollfd> polled{{watcher_.descriptor(), POLLIN, 0}, {wake_, POLLIN, 0}};
  if (worker_.running()) polled.push_back({worker_.socket().descriptor(), POLLIN, 0});
  // A signal that comes just before poll() begins does not end poll(): return about every 0.1 s, to check
  // interrupted().
  const double longest = std::min(watcher_.settles_in().value_or(0.1), 0.1);
  ::poll(polled.data(), polled.size(), int(longest * 1000) + 1);
}

// ---- Requests ----

std::vector<std::string> Supervisor::defines() const {
  std::vector<std::string> list;
  for (const auto& [key, value] : defines_) list.push_back(key + "=" + value);
  return list;
}

std::vector<std::string> Supervisor::views() const {
  if (view_ == "difference") return {"gpu", "reference"};
  return {view_};
}

// Starts a new revision: files or defines have changed.
void Supervisor::begin_revision() {
  ++revision_;
  ++edit_;
  began_ = SourceFiles::now();
  request();
}

void Supervisor::request() {
  watch();
  ++generation_;
  probing_ = false;  // its answer would be of an older request, so the probe is sent again
  result_.reset();
  board_.update([&](Json& status) {
    status["state"] = "loading";
    status["stale"] = true;
    status["view"] = view_;
    status["generation"] = generation_;
    status["edit"] = edit_;
    status["defines"] = defines_;
    status["chosen"] = tunables_;
  });
  request_worker();
}

void Supervisor::request_worker() {
  // A new worker may start slowly: `grace` applies only to one that already runs.
  heard_ = !worker_.running();
  if (heard_) worker_.start();
  busy_ = true;
  since_message_ = {};
  const Message message{{{"do", "render"},
                         {"revision", revision_},
                         {"shaders_changed", shaders_changed_},
                         {"generation", generation_},
                         {"defines", defines()},
                         {"tunables", tunables_},
                         {"views", views()},
                         {"previews", !options_.once}},
                        ""};
  if (!worker_.socket().send(message)) lose_worker(ExitCode::bad_input, "");
}

// ---- The worker ----

void Supervisor::take_messages() {
  while (worker_.running()) {
    const std::optional<Message> message = worker_.socket().receive(0);
    if (message) {
      // A shader may have written over the worker's message.
      try {
        if (message->json.value("generation", int64_t{-1}) != generation_)
          continue;  // it answers an older request
        heard_ = true;
        since_message_ = {};
        handle(*message);
      } catch (const Json::exception&) {
        lose_worker(ExitCode::bad_input, "the rendering process sent an invalid message");
      }
      continue;
    }
    if (worker_.socket().closed())
      lose_worker(ExitCode::bad_input, "");
    else if (busy_ && !heard_ && since_message_.seconds() > grace)
      worker_.kill(), request_worker();
    else if (busy_ && since_message_.seconds() > options_.timeout_seconds + patience && !worker_.debugged())
      lose_worker(ExitCode::timed_out, fmt::format("no answer for {}: does a shader never end?",
                                                   format_seconds(options_.timeout_seconds + patience)));
    return;
  }
}

// Kills a worker that is of no more use; the next request starts another. Empty `message`: the worker ended
// by itself.
void Supervisor::lose_worker(ExitCode code, const std::string& message) {
  const std::string how = worker_.kill();
  if (!std::exchange(busy_, false)) return;  // it was idle: no request has failed
  const std::string why = message.empty() ? "the rendering process ended by " + how : message;
  fail({{"event", "failed"}, {"code", int(code)}, {"message", why}, {"diagnostics", Json::array()}});
}

void Supervisor::handle(const Message& message) {
  const Json& json = message.json;
  const std::string event = json.value("event", "");
  if (event == "rows") {
    board_.put_rows(message);
    report_(json);
    board_.update([&](Json& status) {
      status["stale"] = false;
      status["failure"] = nullptr;
      status["sample"] = json.value("sample", 0);
      status["preview"] = json.value("preview", false);
    });
  } else if (event == "stage") {
    report_(json);
    board_.update([&](Json& status) {
      status["state"] = json.value("stage", "");
      status["share"] = json.value("share", Json());
    });
  } else if (event == "scene") {
    scene_files_ = paths(json.value("files", Json::array()));
    board_.update([&](Json& status) {
      for (const char* key :
           {"width", "height", "samples", "camera", "warnings", "denoise", "scene_tunables"})
        status[key] = json.value(key, Json());
    });
  } else if (event == "tunables") {
    board_.update([&](Json& status) { status["tunables"] = json.value("tunables", Json::array()); });
  } else if (event == "done") {
    if (!json.value("last", true)) return;
    busy_ = false;
    shaders_changed_ = false;
    shader_files_ = paths(json.value("files", Json::array()));
    result_ = ExitCode::ok;
    seen_any_ = true;
    board_.update([&](Json& status) {
      status["state"] = "done";
      for (const char* key : {"device", "seconds", "stages", "rays", "noise_left", "doubts"})
        status[key] = json.value(key, Json());
    });
    watch();
    report_(json);
  } else if (event == "failed") {
    busy_ = false;
    const auto code = ExitCode(json.value("code", 2));
    // A process cannot go on using a device that was lost or that still runs a shader.
    if (code == ExitCode::timed_out || code == ExitCode::no_device) worker_.kill();
    fail(json);
  } else if (event == "probed") {
    busy_ = false;
    if (std::exchange(probing_, false)) probe_.reset();
    Json answer = json;
    answer["edit"] = edit_;
    board_.put_probe(std::move(answer));
  }
}

void Supervisor::fail(Json failure) {
  result_ = ExitCode(failure.value("code", 2));
  if (std::exchange(probing_, false)) probe_.reset();  // the same probe would fail again
  // The files that the attempt read are not known; its messages name some of them.
  for (const Json& diagnostic : failure.value("diagnostics", Json::array()))
    scene_files_.insert(diagnostic.value("file", ""));
  for (const fs::path& shader : shaders_in(options_.shader_folder)) shader_files_.insert(shader);
  board_.update([&](Json& status) {
    status["state"] = "failed";
    status["failure"] = failure;
  });
  watch();
  report_(failure);
}

// ---- Files ----

void Supervisor::watch() {
  std::set<fs::path> files = scene_files_;
  files.insert(options_.scene);
  if (shader_files_.empty()) shader_files_ = shaders_in(options_.shader_folder);
  files.insert(shader_files_.begin(), shader_files_.end());
  files_.set(files, began_);
  WatchList list{{files.begin(), files.end()}, {}, {".glsl", ".h"}};
  if (!options_.shader_folder.empty()) list.folders.push_back(options_.shader_folder);
  watcher_.watch(list);
}

void Supervisor::take_changes() {
  std::set<fs::path> changed;
  if (!watcher_.take_changes().empty() || files_.any_unknown()) changed = files_.changed();
  if (changed.empty() && since_look_.seconds() > seconds_between_looks) {
    since_look_ = {};
    changed = files_.changed_unnoticed();
  }
  if (changed.empty()) return;
  Json names = Json::array();
  for (const fs::path& file : changed) names.push_back(file.filename().string());
  report_({{"event", "changed"}, {"files", std::move(names)}});
  shaders_changed_ =
      std::ranges::any_of(changed, [&](const fs::path& file) { return shader_files_.contains(file); });
  begin_revision();
}

// ---- The page ----

void Supervisor::take_commands() {
  eventfd_t count;
  ::eventfd_read(wake_, &count);
  std::vector<Json> commands;
  {
    const std::lock_guard lock(commands_mutex_);
    commands.swap(commands_);
  }
  for (const Json& command : commands) obey(command);
}

void Supervisor::obey(const Json& command) {
  if (command.contains("view") && command["view"].is_string()) {
    view_ = command["view"];
    request();
  }
  // Values to lay over the scene; null removes one.
  if (const auto found = command.find("defines"); found != command.end() && found->is_object()) {
    for (const auto& [key, value] : found->items()) {
      if (value.is_null())
        defines_.erase(key);
      else
        defines_[key] = value.is_string() ? value.get<std::string>() : json_text(value);
    }
    begin_revision();
  }
  // Values of shaders' constants, by id; null restores the value in the shader's text.
  if (const auto found = command.find("tunables"); found != command.end() && found->is_object()) {
    for (const auto& [id, value] : found->items()) {
      if (value.is_array())
        tunables_[id] = value;
      else
        tunables_.erase(id);
    }
    ++edit_;
    request();
  }
  if (const auto found = command.find("probe"); found != command.end() && found->is_array() &&
                                                found->size() == 2 && (*found)[0].is_number_integer() &&
                                                (*found)[1].is_number_integer())
    probe_ = {(*found)[0], (*found)[1]}, probing_ = false;
}

// Does nothing while the worker renders: the probe waits until the picture is done.
void Supervisor::send_probe() {
  if (!probe_ || busy_ || !worker_.running()) return;
  busy_ = probing_ = true;
  since_message_ = {};
  worker_.socket().send({{{"do", "probe"}, {"x", probe_->first}, {"y", probe_->second}}, ""});
}

}  // namespace eyeray::engine::dev
