// eyeray dev: renders, watches the scene and the shaders, and renders again on every save. The rendering is
// done in a worker process, so that a shader which never ends or crashes the driver costs nothing but a line
// of text.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/cli/picture.hpp"
#include "host/core/readable.hpp"
#include "host/core/termination.hpp"
#include "host/dev/file_watcher.hpp"
#include "host/dev/worker.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

struct DevCommand {
  PictureRequest request;
  bool json = false;

  ExitCode run();

 private:
  dev::WatchList watch_list() const;
  // Renders once in the worker and tells how it went; the fault when there was one.
  std::optional<ExitCode> render_once(dev::Worker& worker);
  void report_picture(const Json& answer);
  ExitCode report_fault(ExitCode code, const std::string& text, const Json& error);

  std::vector<fs::path> sources_;  // what the last renders read
  std::string device_;
};

// In the worker: {"picture": {…}, "line": "…", "sources": […]} or {"error": {…}, "text": "…"}.
Json answer(const PictureRequest& request) {
  Json sources = Json::array();
  try {
    const Picture picture = make_picture(request, {});
    for (const fs::path& source : picture.sources) sources.push_back(source.string());
    std::string line = fmt::format("rendered {} in {} ({})", request.outputs[0],
                                   format_seconds(picture.seconds), stages(picture.times));
    if (const std::string warning = flag_warning(picture); !warning.empty())
      line += "\neyeray: warning: " + warning;
    return {{"picture", to_json(picture)}, {"line", line}, {"sources", sources}};
  } catch (const InputError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) sources.push_back(diagnostic.position.file);
    return {{"error", to_json(error)}, {"text", error.what()}, {"sources", sources}};
  } catch (const Error& error) {
    return {{"error", to_json(error)},
            {"text", fmt::format("eyeray: error: {}", error.what())},
            {"sources", sources}};
  } catch (const std::exception& error) {
    const Error wrapped(ExitCode::bad_input, error.what());
    return {{"error", to_json(wrapped)},
            {"text", fmt::format("eyeray: error: {}", error.what())},
            {"sources", sources}};
  }
}

dev::WatchList DevCommand::watch_list() const {
  dev::WatchList list{sources_, {}, {".glsl", ".h"}};
  list.files.emplace_back(request.scene.file());
  if (!request.executor.shader_folder.empty()) list.folders.push_back(request.executor.shader_folder);
  return list;
}

void DevCommand::report_picture(const Json& answer) {
  if (json) print_json({{"picture", answer["picture"]}});
  const std::string device = answer["picture"]["device"];
  if (device != device_) fmt::print(stderr, "{}\n", device);
  device_ = device;
  fmt::print(stderr, "{}\n", answer["line"].get<std::string>());
}

ExitCode DevCommand::report_fault(ExitCode code, const std::string& text, const Json& error) {
  if (json) print_json({{"error", error}});
  fmt::print(stderr, "{}\n{} stays as it was\n", text, request.outputs[0]);
  return code;
}

std::optional<ExitCode> DevCommand::render_once(dev::Worker& worker) {
  const auto fault = [this](ExitCode code, const std::string& message) {
    return report_fault(code, "eyeray: error: " + message, to_json(Error(code, message)));
  };
  const double timeout = request.executor.timeout_seconds;
  const dev::Worker::Answer reply = worker.ask("render", timeout);
  switch (reply.outcome) {
    case dev::Worker::Outcome::interrupted:
      return ExitCode::interrupted;
    case dev::Worker::Outcome::timed_out:
      return fault(ExitCode::timed_out,
                   fmt::format("no picture after {}: a shader that never ends? (--timeout allows longer)",
                               format_seconds(timeout)));
    case dev::Worker::Outcome::died:
      return fault(ExitCode::bad_input, "the rendering process ended by " + reply.text);
    case dev::Worker::Outcome::answered:
      break;
  }

  const Json answer = Json::parse(reply.text);
  if (answer.contains("picture")) {
    sources_.clear();
    for (const std::string file : answer["sources"]) sources_.emplace_back(file);
    report_picture(answer);
    return std::nullopt;
  }
  // What the failed attempt read is not known; its messages name some of it.
  for (const std::string file : answer["sources"]) sources_.emplace_back(file);
  const auto code = ExitCode(answer["error"]["code"].get<int>());
  // A device that was lost or still runs a shader is of no more use to its process.
  if (code == ExitCode::timed_out || code == ExitCode::no_device) worker.kill();
  return report_fault(code, answer["text"], answer["error"]);
}

ExitCode DevCommand::run() {
  request.check_outputs();
  if (!fs::exists(request.scene.file())) request.scene.load();  // throws, with the loader's own words

  dev::Worker worker([this](const std::string&) {
    return answer(request).dump(-1, ' ', false, Json::error_handler_t::replace);
  });
  dev::FileWatcher watcher;
  for (bool first = true; !interrupted(); first = false) {
    // Watch before rendering: a save during the rendering is not lost.
    watcher.watch(watch_list());
    const std::optional<ExitCode> fault = render_once(worker);
    if (first && fault == ExitCode::no_device) return *fault;  // no save will help
    if (fault == ExitCode::interrupted) break;
    watcher.watch(watch_list());
    if (first) fmt::print(stderr, "watching for changes; Ctrl-C ends\n");
    std::fflush(stdout);
    const std::set<std::string> changed = watcher.wait();
    if (!changed.empty()) fmt::print(stderr, "\n{} changed\n", fmt::join(changed, ", "));
  }
  return ExitCode::interrupted;
}

}  // namespace

void add_dev(CLI::App& app, Run& run) {
  CLI::App* const command =
      app.add_subcommand("dev", "Render, and again on every save of the scene or a shader.");
  const auto options = std::make_shared<DevCommand>();
  options->request.executor.timeout_seconds = 20;
  options->request.add_to(*command);
  command->add_flag("--json", options->json, "Say each result as a line of JSON on standard output.");
  command->footer(
      "Example:\n"
      "  eyeray shaders --export my-shaders\n"
      "  eyeray dev scenes/whitted.toml --shaders my-shaders -o look.png\n"
      "Errors are shown as file:line: error and leave the last good picture alone. A render that takes "
      "longer than\n"
      "--timeout is stopped. Ctrl-C ends it all, with exit code 130.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::cli
