#include "host/dev/render_server.hpp"

#include <algorithm>

#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"
#include "host/probe/probe.hpp"

namespace eyeray::dev {
namespace {

// "path" is for editors: nothing of the shaders that are embedded.
Json to_json(const Diagnostic& diagnostic) {
  std::error_code error;
  const bool on_disk = std::filesystem::is_regular_file(diagnostic.position.file, error);
  return {{"severity", diagnostic.severity == Severity::error ? "error" : "warning"},
          {"file", diagnostic.position.file},
          {"path", on_disk ? std::filesystem::absolute(diagnostic.position.file, error).string() : ""},
          {"line", diagnostic.position.line},
          {"column", diagnostic.position.column},
          {"message", diagnostic.message},
          {"source", diagnostic.source_line},
          {"source_column", diagnostic.source_column}};
}

Json to_json(const std::vector<Diagnostic>& diagnostics) {
  Json json = Json::array();
  for (const Diagnostic& diagnostic : diagnostics) json.push_back(to_json(diagnostic));
  return json;
}

Json to_json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

RenderServer::RenderServer(Options options, MessageSocket socket)
    : options_(std::move(options)), socket_(std::move(socket)) {}

void RenderServer::serve() {
  while (!socket_.closed() && !interrupted()) {
    const std::optional<Message> message = socket_.receive(1);
    if (!message) continue;
    const std::string what = message->json.value("do", "");
    if (what == "render") render(message->json);
    if (what == "probe") probe(message->json);
  }
}

void RenderServer::send(const char* event, Json json, std::string bytes) {
  json["event"] = event;
  json["generation"] = generation_;
  socket_.send({std::move(json), std::move(bytes)});
}

void RenderServer::send_failure(const Error& error) {
  Json json{{"code", int(error.code())}, {"message", error.what()}, {"diagnostics", Json::array()}};
  if (const auto* input = dynamic_cast<const InputError*>(&error))
    json["diagnostics"] = to_json(input->diagnostics());
  send("failed", std::move(json));
}

void RenderServer::render(const Json& request) {
  generation_ = request.value("generation", int64_t{0});
  try {
    if (request.value("revision", int64_t{0}) != revision_) load(request);
    const auto views = request.value("views", std::vector<std::string>{"gpu"});
    for (size_t i = 0; i < views.size() && !outdated(); ++i) paint(views[i], i + 1 == views.size());
  } catch (const Error& error) {
    send_failure(error);
  } catch (const std::exception& error) {
    send_failure(Error(ExitCode::bad_input, error.what()));
  }
}

void RenderServer::load(const Json& request) {
  revision_ = -1;
  executors_.clear();
  send("stage", {{"stage", "load"}});
  scene_ = options_.load(request.value("defines", std::vector<std::string>{}));
  revision_ = request.value("revision", int64_t{0});
  own_kernel_ = request.value("shaders_changed", true);

  Json files = Json::array();
  for (const auto& file : scene_->files) files.push_back(file.string());
  send("scene", {{"width", scene_->image.width},
                 {"height", scene_->image.height},
                 {"samples", scene_->image.samples},
                 {"files", std::move(files)},
                 {"warnings", to_json(scene_->warnings)},
                 {"camera",
                  {{"eye", to_json(scene_->camera.eye)},
                   {"target", to_json(scene_->camera.target)},
                   {"up", to_json(scene_->camera.up)}}}});
}

executors::Executor& RenderServer::executor_for(const View& view) {
  auto& executor = executors_[{view.backend, view.needs()}];
  if (executor) return *executor;
  send("stage", {{"stage", "compile"}});
  if (view.backend == executors::Backend::gpu && !options_.executor.open_device)
    options_.executor.open_device = executors::open_device(options_.executor);
  executors::ExecutorOptions options = options_.executor;
  options.constants = options.constants && own_kernel_;
  options.ray_kinds = view.needs() == aov::AovNeeds::ray_kinds;
  options.search_cost = view.needs() == aov::AovNeeds::search_cost;
  executor = executors::make_executor(view.backend, *scene_, options);
  return *executor;
}

void RenderServer::paint(const std::string& name, bool last) {
  const Stopwatch watch;
  const View view = parse_view(name);
  executors::Executor& executor = executor_for(view);
  if (outdated()) return;
  send("stage", {{"stage", "render"}});
  const auto painted = dev::paint(view, *scene_, executor, [&](const PaintedRows& painted_rows) {
    const image::Image& rows = painted_rows.rows;
    Json json{{"view", name},
              {"width", scene_->image.width},
              {"height", scene_->image.height},
              {"row", painted_rows.first},
              {"rows", rows.height()},
              {"stride", painted_rows.stride},
              {"channels", rows.channels()},
              {"sample", painted_rows.sample}};
    if (view.aov) json["shown_as"] = int(view.aov->shown_as);
    send("rows", std::move(json),
         {reinterpret_cast<const char*>(rows.samples().data()), rows.sample_count() * sizeof(float)});
    return !outdated();
  });
  if (!painted) return;

  Json files = Json::array();
  for (const auto& file : executor.source_files()) files.push_back(file.string());
  Json stages = Json::object();
  for (const auto& [stage, seconds] : executor.times().stages()) stages[stage] = seconds;
  send("done", {{"view", name},
                {"last", last},
                {"device", executor.description()},
                {"seconds", watch.seconds()},
                {"stages", std::move(stages)},
                {"rays", painted->rays},
                {"samples", scene_->image.samples},
                {"flags", painted->flags},
                {"flagged_samples", painted->flagged_samples},
                {"files", std::move(files)}});
}

void RenderServer::probe(const Json& request) {
  probe::Options options;
  options.executor = options_.executor;
  options.x = request.value("x", 0);
  options.y = request.value("y", 0);
  Json answer{{"x", options.x}, {"y", options.y}};
  try {
    if (!scene_) throw Error(ExitCode::bad_input, "there is no scene to look into yet");
    const probe::Findings findings = probe::probe_pixel(*scene_, options);
    answer["findings"] = Json::parse(probe::to_json(findings));
    answer["text"] = probe::to_text(findings, false);
  } catch (const std::exception& error) {
    answer["message"] = error.what();
  }
  send("probed", std::move(answer));
}

}  // namespace eyeray::dev
