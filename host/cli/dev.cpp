// eyeray dev: renders, watches the scene and the shaders, and renders again on every save
// (dev/supervisor.hpp).
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/cli/command.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/github_text.hpp"
#include "host/core/process.hpp"
#include "host/core/readable.hpp"
#include "host/core/standard_streams.hpp"
#include "host/dev/render_server.hpp"
#include "host/dev/supervisor.hpp"
#include "host/image/image_file.hpp"
#include "host/program/json.hpp"

namespace eyeray::engine::cli {
namespace {

constexpr int usual_port = 7447;

struct DevCommand {
  SceneOptions scene;
  executors::Backend backend = executors::Backend::gpu;
  executors::ExecutorOptions executor;
  std::vector<std::string> outputs;
  std::string diagnostics = "gcc";
  bool json = false;
  bool once = false;
  bool no_page = false;
  int port = usual_port;
  int worker_socket = -1;  // the descriptor, in the worker; else -1

  ExitCode run();

 private:
  ExitCode serve();
  void report(const Json& event, const dev::Board& board);
  void report_picture(const Json& done, const dev::Board& board);
  void report_failure(const Json& failure) const;

  std::string device_;
  bool watching_ = false;
  std::shared_ptr<void> compiling_;  // the line that reports that kernels compile
};

// "::error file=a.glsl,line=3,col=5::message", as GitHub's workflows read it.
std::string github_annotation(const Json& diagnostic) {
  return fmt::format("::{} file={},line={},col={}::{}", diagnostic.value("severity", "error"),
                     github_text(diagnostic.value("file", ""), true), diagnostic.value("line", 0),
                     diagnostic.value("column", 0), github_text(diagnostic.value("message", ""), false));
}

void DevCommand::report_picture(const Json& done, const dev::Board& board) {
  if (const auto picture = board.picture(done.value("view", "gpu"))) {
    try {
      for (const std::string& output : outputs) image::write_image(output, picture->image);
    } catch (const Error& error) {  // go on: the next picture may find room
      if (once) throw;
      print_lines(stderr, "eyeray: error: {}\n", error.what());
      return;
    }
  }
  if (json) {
    Json answer = done;
    answer["files"] = outputs;
    answer.erase("event");
    answer.erase("generation");
    print_json({{"picture", std::move(answer)}});
  }
  const std::string device = done.value("device", "");
  if (device != device_) print_lines(stderr, "{}\n", device);
  device_ = device;
  std::vector<std::string> stages;
  const Json times = done.value("stages", Json::object());
  for (const auto& [stage, seconds] : times.items())
    stages.push_back(fmt::format("{} {}", stage, format_seconds(seconds)));
  for (const std::string& doubt : done.value("doubts", std::vector<std::string>{}))
    print_lines(stderr, "eyeray: warning: {}\n", doubt);
  print_lines(stderr, "rendered {}in {} ({})\n", outputs.empty() ? "" : outputs[0] + " ",
              format_seconds(done.value("seconds", 0.0)), fmt::join(stages, ", "));
}

void DevCommand::report_failure(const Json& failure) const {
  const Json diagnostics_found = failure.value("diagnostics", Json::array());
  if (json) {
    Json answer = failure;
    answer.erase("event");
    answer.erase("generation");
    print_json({{"error", std::move(answer)}});
  }
  const std::string message = failure.value("message", "");
  if (diagnostics == "json") {
    fmt::print(stderr, "{}\n", json_text(Json{{"message", message}, {"diagnostics", diagnostics_found}}));
  } else if (diagnostics == "github" && !diagnostics_found.empty()) {
    for (const Json& each : diagnostics_found) fmt::print(stderr, "{}\n", github_annotation(each));
  } else {
    print_lines(stderr, "{}{}\n", diagnostics_found.empty() ? "eyeray: error: " : "", message);
  }
  if (!once && !outputs.empty()) print_lines(stderr, "{} is unchanged\n", outputs[0]);
}

void DevCommand::report(const Json& event, const dev::Board& board) {
  const std::string what = event.value("event", "");
  // Previews are rows of a picture whose kernel still compiles.
  if (what != "rows") compiling_.reset();
  if (what == "stage" && event.value("stage", "") == "compile") compiling_ = show_compiling();
  if (what == "listening") {
    const int listens = event.value("port", 0);
    if (listens != event.value("wanted", 0))
      print_lines(stderr, "port {} is in use; the page is on port {}\n", event.value("wanted", 0), listens);
    print_lines(stderr,
                "open {} in a browser\n"
                "from another machine, first run: ssh -L {}:127.0.0.1:{} THIS-MACHINE\n",
                event.value("address", ""), listens, listens);
  }
  if (what == "changed")
    print_lines(stderr, "\n{} changed\n", fmt::join(event.value("files", std::vector<std::string>{}), ", "));
  if (what == "done") report_picture(event, board);
  if (what == "failed") report_failure(event);
  if ((what == "done" || what == "failed") && !once && !watching_) {
    watching_ = true;
    print_lines(stderr, "watching for changes; Ctrl-C ends\n");
  }
  std::fflush(stdout);
}

ExitCode DevCommand::serve() {
  dev::be_a_worker();
  dev::RenderServer server(
      {.load = [this](const std::vector<std::string>& defines) { return scene.with_defines(defines).load(); },
       .executor = executor},
      dev::MessageSocket(worker_socket));
  server.serve();
  return ExitCode::ok;
}

ExitCode DevCommand::run() {
  if (worker_socket >= 0) return serve();
  for (const std::string& output : outputs) {
    image::image_format(output);
    check_writable(output);
  }
  if (!std::filesystem::exists(scene.file())) scene.load();  // throws the loader's own error

  dev::SupervisorOptions options;
  options.worker = own_command();
  options.worker.push_back("--worker-socket");
  options.scene = scene.file();
  options.shader_folder = executor.shader_folder;
  options.view = executors::backend_name(backend);
  options.timeout_seconds = std::max(executor.gpu.timeout_seconds, executor.gpu.least_compile_seconds);
  options.once = once;
  if (!no_page) options.port = port;
  dev::Supervisor* known = nullptr;
  dev::Supervisor supervisor(options, [&](const Json& event) { report(event, known->board()); });
  known = &supervisor;
  return supervisor.run();
}

}  // namespace

void add_dev(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand(
      "dev", "Render on every save of the scene or a shader, and show the picture on a page in the browser.");
  const auto options = std::make_shared<DevCommand>();
  // Dispatches are sized to take 40 ms; compiling may take much longer.
  options->executor.gpu.timeout_seconds = 2;
  options->executor.gpu.least_compile_seconds = 60;
  options->executor.gpu.validate_spirv = true;
  options->scene.add_to(*command);
  command
      ->add_option("-o,--output", options->outputs,
                   "Also write each finished picture: .png, .pfm, .hdr or .exr. May be repeated.")
      ->option_text("FILE")
      ->allow_extra_args(false)
      ->take_all();
  command
      ->add_option("--port", options->port,
                   "The page's port on 127.0.0.1. If it is in use, dev takes another one.")
      ->option_text(fmt::format("N={}", usual_port))
      ->check(whole_within(1, 65535));
  command->add_flag("--no-page", options->no_page, "Serve no page for a browser.");
  command->add_flag("--once", options->once, "Render once and end, with exit code 0 or the fault's.");
  command
      ->add_option("--diagnostics", options->diagnostics,
                   "The format of errors on standard error: gcc, json or github.")
      ->option_text("FORMAT=gcc")
      ->check(one_of({"gcc", "json", "github"}));
  add_backend_option(*command, options->backend);
  add_executor_options(*command, options->executor);
  command->add_flag("--json", options->json, "Print each result as a line of JSON on standard output.");
  command->add_option("--worker-socket", options->worker_socket, "")->group("");
  command->footer(
      "Example:\n"
      "  eyeray shaders --export my-shaders\n"
      "  eyeray dev scenes/whitted.toml --shaders my-shaders\n"
      "Errors are shown as file:line:column: error; the last good picture stays. A\n"
      "shader that does not end is stopped after --timeout. Ctrl-C ends dev with exit\n"
      "code 130.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::engine::cli
