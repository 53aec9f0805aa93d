#include "host/dev/render_server.hpp"

#include <algorithm>

#include "host/core/atomic_file.hpp"
#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"
#include "host/dev/scene_tunables.hpp"
#include "host/executors/cpp_compiler.hpp"
#include "host/probe/probe.hpp"
#include "host/render/flags.hpp"

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
    : options_(std::move(options)),
      socket_(std::move(socket)),
      tunables_(std::make_shared<executors::Tunables>()) {
  options_.executor.tunables = tunables_;
}

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
    choose_tunables(request.value("tunables", Json::object()));
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
  tunables_->begin();
  tunables_->as_constants = false;
  send("stage", {{"stage", "load"}});
  scene_ = options_.load(request.value("defines", std::vector<std::string>{}));
  revision_ = request.value("revision", int64_t{0});

  Json tunables = Json::array();
  if (!scene_->files.empty() && scene_->files[0].extension() == ".toml")
    for (const SceneTunable& each : scene_tunables(read_file(scene_->files[0])))
      tunables.push_back({{"id", each.key},
                          {"name", each.key},
                          {"type", each.type},
                          {"low", each.low},
                          {"high", each.high},
                          {"written", each.written},
                          {"value", each.written}});
  // What has sliders is about to move.
  own_kernel_ = request.value("shaders_changed", true) && tunables.empty();
  Json files = Json::array();
  for (const auto& file : scene_->files) files.push_back(file.string());
  send("scene", {{"width", scene_->image.width},
                 {"height", scene_->image.height},
                 {"samples", scene_->image.samples},
                 {"files", std::move(files)},
                 {"scene_tunables", std::move(tunables)},
                 {"warnings", to_json(scene_->warnings)},
                 {"camera",
                  {{"eye", to_json(scene_->camera.eye)},
                   {"target", to_json(scene_->camera.target)},
                   {"up", to_json(scene_->camera.up)}}}});
}

executors::Executor& RenderServer::executor_for(const View& view) {
  const auto known = executors_.find({view.backend, view.needs()});
  if (known != executors_.end()) return *known->second;
  send("stage", {{"stage", "compile"}});
  if (view.backend == executors::Backend::gpu && !options_.executor.open_device)
    options_.executor.open_device = executors::open_device(options_.executor);
  if (view.backend == executors::Backend::twin && !options_.executor.shader_folder.empty())
    options_.executor.compile_twin = !executors::cpp_compiler().empty();
  executors::ExecutorOptions options = options_.executor;
  options.constants = options.constants && own_kernel_;
  options.formula_numbers = !own_kernel_;
  options.ray_kinds = view.needs() == aov::AovNeeds::ray_kinds;
  options.search_cost = view.needs() == aov::AovNeeds::search_cost;
  std::unique_ptr<executors::Executor> executor;
  try {
    executor = executors::make_executor(view.backend, *scene_, options);
  } catch (const InputError&) {
    // What moves may stand where the language wants a constant.
    if (tunables_->found().empty() || tunables_->as_constants) throw;
    tunables_->as_constants = true;
    executor = executors::make_executor(view.backend, *scene_, options);
  }
  if (view.backend == executors::Backend::gpu) send_tunables();
  return *(executors_[{view.backend, view.needs()}] = std::move(executor));
}

void RenderServer::choose_tunables(const Json& values) {
  std::map<std::string, executors::Tunable::Value> chosen;
  for (const auto& [id, numbers] : values.items()) {
    executors::Tunable::Value value{};
    for (size_t i = 0; i < std::min(numbers.size(), value.size()); ++i)
      if (numbers[i].is_number()) value[i] = numbers[i];
    chosen[id] = value;
  }
  if (std::exchange(tunables_->chosen, chosen) == chosen) return;
  if (tunables_->as_constants)
    executors_.clear();
  else
    for (const auto& [kind, executor] : executors_) executor->reload_tunables();
}

void RenderServer::send_tunables() {
  constexpr const char* types[] = {"float", "int", "bool", "vec3"};
  Json list = Json::array();
  for (const executors::Tunable& each : tunables_->found())
    list.push_back({{"id", each.id},
                    {"name", each.name},
                    {"type", types[size_t(each.type)]},
                    {"low", each.low},
                    {"high", each.high},
                    {"written", each.written},
                    {"value", tunables_->value(each)}});
  send("tunables", {{"tunables", std::move(list)}});
}

void RenderServer::paint(const std::string& name, bool last) {
  const Stopwatch watch;
  const View view = parse_view(name);
  const auto known = executors_.find({view.backend, view.needs()});
  const StageTimes before = known != executors_.end() ? known->second->times() : StageTimes();
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
  for (const auto& [stage, seconds] : before.stages()) stages[stage] = stages[stage].get<double>() - seconds;
  send("done", {{"view", name},
                {"last", last},
                {"device", executor.description()},
                {"seconds", watch.seconds()},
                {"stages", std::move(stages)},
                {"rays", painted->rays},
                {"samples", scene_->image.samples},
                {"doubts", doubts(view, *painted)},
                {"files", std::move(files)}});
}

std::vector<std::string> RenderServer::doubts(const View& view, const Painted& painted) const {
  std::vector<std::string> doubts;
  if (painted.flags != 0) doubts.push_back(render::flag_warning(painted.flags, painted.flagged_pixels));
  const std::string shaders = options_.executor.shader_folder.string();
  if (view.backend != executors::Backend::twin || shaders.empty()) return doubts;
  if (!options_.executor.compile_twin)
    doubts.push_back(fmt::format(
        "this is the twin of eyeray's own shaders: for those of {} there is no C++ compiler (c++, "
        "g++, clang++ or $CXX)",
        shaders));
  else if (!tunables_->chosen.empty())
    doubts.push_back("the twin has the values that are written in the shaders, not those of the sliders");
  return doubts;
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
