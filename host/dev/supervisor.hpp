// eyeray dev: watches files, has a worker render them, shows the picture and the faults, and
// outlives the worker's crashes.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/core/error.hpp"
#include "host/dev/board.hpp"
#include "host/dev/file_watcher.hpp"
#include "host/dev/source_files.hpp"
#include "host/dev/web_server.hpp"
#include "host/dev/worker.hpp"

namespace eyeray::engine::dev {

struct SupervisorOptions {
  std::vector<std::string> worker;      // the command line of a RenderServer
  std::filesystem::path scene;          // watched from the start
  std::filesystem::path shader_folder;  // watched from the start; empty: none
  std::string view = "gpu";             // the view shown first
  double timeout_seconds = 20;          // the time-out of a worker that sends nothing
  std::optional<int> port;              // the port of the page; none: no page
  bool once = false;                    // end with the first picture, or with its failure
};

class Supervisor {
 public:
  // Receives events, on the supervisor's thread: the worker's "stage", "rows", "done" and "failed"
  // (render_server.hpp), and {"event": "changed", "files": […]} or {"event": "listening", "address": …}. A
  // failure's "message" is ready for a terminal.
  using Report = std::function<void(const Json&)>;
  Supervisor(SupervisorOptions options, Report report);

  // begin() serves the page and requests the first picture. Then step() is called again and again: it waits a
  // little for events, and handles them.
  void begin();
  void step();
  // Calls begin(), then step() until interrupted() is true or, with `once`, the first picture is done or has
  // failed. Ends too if no device was found and no picture was ever shown. Returns the exit code.
  ExitCode run();
  const Board& board() const { return board_; }

 private:
  void request();
  void request_worker();
  void begin_revision();
  void take_messages();
  void handle(const Message& message);
  void lose_worker(ExitCode code, const std::string& message);
  void fail(Json failure);
  void take_changes();
  void take_commands();
  void obey(const Json& command);
  void watch();
  void wait();
  std::vector<std::string> defines() const;
  std::vector<std::string> views() const;
  void send_probe();

  SupervisorOptions options_;
  Report report_;
  Board board_;
  Worker worker_;
  FileWatcher watcher_;
  SourceFiles files_;
  std::set<std::filesystem::path> scene_files_, shader_files_;  // from which the last pictures were made
  SourceFiles::Clock::time_point began_;
  Stopwatch since_look_;  // since files were last checked without notification

  int64_t revision_ = 0;    // counts changes of files and defines
  int64_t generation_ = 0;  // counts requests
  int64_t edit_ = 0;        // counts changes of files, defines and values of shaders: the pictures' sources
  bool busy_ = false;       // the worker has not answered the last request
  bool heard_ = false;      // the worker has begun the last request
  bool shaders_changed_ = true;  // since the last picture
  WakefulStopwatch since_message_;
  std::string view_;
  std::map<std::string, std::string> defines_;  // the values that the page laid over the scene
  Json tunables_ = Json::object();              // values that the page chose
  std::optional<ExitCode> result_;              // the result of the last request
  bool seen_any_ = false;                       // whether any picture was completed
  std::optional<std::pair<int, int>> probe_;    // the pixel to probe once the worker is idle
  bool probing_ = false;                        // the worker has this probe

  // Commands from the web server's threads.
  std::mutex commands_mutex_;
  std::vector<Json> commands_;
  int wake_ = -1;  // an eventfd

  std::optional<WebServer> server_;  // the last member: its threads use the others
};

}  // namespace eyeray::engine::dev
