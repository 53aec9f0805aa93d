#include "host/dev/render_server.hpp"

#include <algorithm>
#include <chrono>

#include "host/core/atomic_file.hpp"
#include "host/core/processor_time.hpp"
#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"
#include "host/denoise/denoise.hpp"
#include "host/denoise_kernels/device_stages.hpp"
#include "host/dev/scene_tunables.hpp"
#include "host/executors/cpp_compiler.hpp"
#include "host/executors/open_device.hpp"
#include "host/probe/probe.hpp"
#include "host/render/light_meter.hpp"
#include "host/scene/integrator.hpp"
#include "host/session/request.hpp"

namespace eyeray::engine::dev {
namespace {

constexpr std::pair colors_of_gpu(executors::Backend::gpu, film::Needs::nothing);
constexpr int no_sample = -1;
constexpr double seconds_between_reports = 0.1;
constexpr double longest_wait = 3600;  // for a driver; the supervisor kills the worker earlier
// Packing a larger scene twice takes too much memory, and its preview too long.
constexpr uint64_t most_previewed = 1 << 18;

// "path" is for editors: embedded shaders have none.
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
  options_.executor.gpu.tunables = tunables_;
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
  processor_seconds_ = processor_seconds();
  try {
    previews_ = request.value("previews", false);
    if (request.value("revision", int64_t{0}) != revision_) load(request);
    choose_tunables(request.value("tunables", Json::object()));
    const auto views = request.value("views", std::vector<std::string>{"gpu"});
    // Noise counts in a difference of views.
    const bool denoised = views.size() == 1 && scene_->render.denoise && obstacle_to_denoising_.empty();
    for (size_t i = 0; i < views.size() && !outdated(); ++i) paint(views[i], denoised, i + 1 == views.size());
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
  tone_.reset();
  scene_ = std::make_shared<const Scene>(options_.load(request.value("defines", std::vector<std::string>{})));
  revision_ = request.value("revision", int64_t{0});
  obstacle_to_denoising_ = session::obstacle_to_denoising({}, *scene_);

  Json tunables = Json::array();
  if (!scene_->files.empty() && scene_->files[0].extension() == ".toml")
    for (const SceneTunable& each : scene_tunables(read_file(scene_->files[0])))
      tunables.push_back({{"id", each.key},
                          {"owner", each.owner},
                          {"name", each.name},
                          {"type", each.type},
                          {"low", each.low},
                          {"high", each.high},
                          {"written", each.written},
                          {"value", each.written}});
  // A scene with sliders is about to change: its kernel must work for other values too.
  own_kernel_ = request.value("shaders_changed", true) && tunables.empty();
  Json files = Json::array();
  for (const auto& file : scene_->files) files.push_back(file.string());
  send("scene", {{"width", scene_->image.width},
                 {"height", scene_->image.height},
                 {"samples", scene_->image.samples},
                 {"files", std::move(files)},
                 {"scene_tunables", std::move(tunables)},
                 {"warnings", to_json(scene_->warnings)},
                 {"denoise", obstacle_to_denoising_.empty() ? Json(scene_->render.denoise) : Json()},
                 {"camera",
                  {{"eye", to_json(scene_->camera.eye)},
                   {"target", to_json(scene_->camera.target)},
                   {"up", to_json(scene_->camera.up)}}}});
}

executors::ExecutorOptions RenderServer::options_for(const View& view) {
  executors::ExecutorOptions options = session::counting(options_.executor, view.film_channels(*scene_));
  options.gpu.constants = options.gpu.constants && own_kernel_;
  options.gpu.formula_numbers = !own_kernel_;
  return options;
}

executors::Executor& RenderServer::executor_for(const View& view) {
  const auto known = executors_.find({view.backend, view.needs()});
  if (known != executors_.end()) return *known->second;
  send("stage", {{"stage", "compile"}});
  if (view.backend == executors::Backend::gpu) {
    collect(longest_wait);
    std::shared_ptr<executors::OpenDevice>& device = options_.executor.gpu.open_device;
    if (!device) device = executors::open_device(options_.executor.gpu);
  }
  if (view.backend == executors::Backend::twin && !options_.executor.shader_folder.empty())
    options_.executor.twin.compile = !executors::cpp_compiler().empty();
  const executors::ExecutorOptions options = options_for(view);
  std::unique_ptr<executors::Executor> executor;
  try {
    executor = executors::make_executor(view.backend, *scene_, options);
  } catch (const InputError&) {
    // A tunable may stand where the language requires a constant.
    if (tunables_->found().empty() || tunables_->as_constants) throw;
    tunables_->as_constants = true;
    executor = executors::make_executor(view.backend, *scene_, options);
  }
  if (view.backend == executors::Backend::gpu) send_tunables();
  return *(executors_[{view.backend, view.needs()}] = std::move(executor));
}

// ---- Previews ----

bool RenderServer::may_preview(const View& view) const {
  // No previews of edited shaders: they are compiled as C++ only if the user views the twin.
  return previews_ && view.backend == executors::Backend::gpu && !view.aov &&
         !executors_.contains(colors_of_gpu) && options_.executor.shader_folder.empty() &&
         scene_->primitive_count() <= most_previewed && !sends_photons(scene_->render.integrator);
}

void RenderServer::start_making() {
  // Nothing else may use the device while the thread makes the executor.
  std::erase_if(executors_, [](const auto& each) { return each.first.first == executors::Backend::gpu; });
  made_of_ = revision_;
  being_made_ = std::async(std::launch::async, [scene = scene_, options = options_for({})]() mutable {
    if (!options.gpu.open_device) options.gpu.open_device = executors::open_device(options.gpu);
    std::unique_ptr<executors::Executor> executor =
        executors::make_executor(executors::Backend::gpu, *scene, options);
    // Dispatch one row: drivers may compile at the first dispatch.
    const Rect row{0, 0, scene->image.width, 1};
    std::vector<PixelSample> samples(size_t(row.pixels()));
    executor->sample(row, 0, samples);
    return executor;
  });
}

void RenderServer::collect(double seconds) {
  if (!being_made_.valid() ||
      being_made_.wait_for(std::chrono::duration<double>(seconds)) != std::future_status::ready)
    return;
  const bool wanted = made_of_ == revision_;
  try {
    std::unique_ptr<executors::Executor> executor = being_made_.get();
    options_.executor.gpu.open_device = executor->facts().device;
    if (wanted) executors_[colors_of_gpu] = std::move(executor);
  } catch (const std::exception&) {
    if (wanted) throw;
  }
}

bool RenderServer::gpu_is_ready(double seconds) {
  collect(seconds);
  if (executors_.contains(colors_of_gpu)) return true;
  if (!being_made_.valid()) start_making();
  return false;
}

std::optional<int> RenderServer::preview(const std::string& name) {
  send("stage", {{"stage", "compile"}});
  const auto wait = [&](double seconds) {
    const Stopwatch watch;
    while (!outdated() && watch.seconds() < seconds && !gpu_is_ready(0.01)) {
    }
  };
  int begun = no_sample;
  wait(options_.unnoticed_seconds);
  if (!outdated() && !gpu_is_ready(0)) {
    const View twin{executors::Backend::twin};
    dev::paint(twin, *scene_, executor_for(twin), [&](const PaintedRows& rows) {
      begun = rows.sample;
      send_rows(name, twin, rows, true);
      return !outdated() && !gpu_is_ready(0);
    });
    wait(longest_wait);
  }
  return outdated() ? std::nullopt : std::optional(begun);
}

void RenderServer::choose_tunables(const Json& values) {
  std::map<std::string, executors::Tunable::Value> chosen;
  for (const auto& [id, numbers] : values.items()) {
    executors::Tunable::Value value{};
    for (size_t i = 0; i < std::min(numbers.size(), value.size()); ++i)
      if (numbers[i].is_number()) value[i] = numbers[i];
    chosen[id] = value;
  }
  if (tunables_->choose(std::move(chosen)) && tunables_->as_constants) executors_.clear();
}

void RenderServer::send_tunables() {
  constexpr const char* types[] = {"float", "int", "bool", "vec3"};
  Json list = Json::array();
  for (const executors::Tunable& each : tunables_->found())
    list.push_back({{"id", each.id},
                    {"owner", each.file},
                    {"name", each.name},
                    {"type", types[size_t(each.type)]},
                    {"low", each.low},
                    {"high", each.high},
                    {"written", each.written},
                    {"value", tunables_->value(each)}});
  send("tunables", {{"tunables", std::move(list)}});
}

std::optional<double> RenderServer::denoise(const std::string& name, const View& view,
                                            const image::NoisyPicture& noisy,
                                            const executors::Executor& executor) {
  const auto stages = denoise_kernels::make_stages(executor.facts().device, options_.executor);
  const auto report = [&](double share) { send("stage", {{"stage", "denoise"}, {"share", share}}); };
  Stopwatch since_report;
  report(0);
  stages->report_to([&](double share) {
    if (since_report.seconds() > seconds_between_reports) {
      report(share);
      since_report = {};
    }
    return !outdated();
  });
  try {
    const image::DenoisedPicture picture = denoise::denoise(noisy, *stages);
    send_rows(name, view, {picture.color, 0, 1, scene_->image.samples - 1}, false);
    return picture.error;
  } catch (const Error& error) {
    if (error.code() != ExitCode::interrupted) throw;
    return std::nullopt;
  }
}

void RenderServer::paint(const std::string& name, bool denoised, bool last) {
  const Stopwatch watch;
  View view = parse_view(name);
  view.denoised = denoised && !view.aov;
  const auto known = executors_.find({view.backend, view.needs()});
  const StageTimes before = known != executors_.end() ? known->second->times() : StageTimes();
  const std::optional<int> shown = may_preview(view) ? preview(name) : no_sample;
  if (!shown) return;
  executors::Executor& executor = executor_for(view);
  if (outdated()) return;
  send("stage", {{"stage", "render"}});
  const auto painted = dev::paint(view, *scene_, executor, [&](const PaintedRows& rows) {
    // Skip rows that are coarser than those that a preview has shown.
    const bool is_news = *shown == no_sample || (rows.stride == 1 && rows.sample >= *shown);
    if (is_news) send_rows(name, view, rows, false);
    return !outdated();
  });
  if (!painted) return;
  const Stopwatch denoise_watch;
  const std::optional<double> noise_left =
      view.denoised ? denoise(name, view, *painted->noisy, executor) : std::nullopt;
  if (view.denoised && !noise_left) return;

  Json files = Json::array();
  for (const auto& file : executor.facts().source_files) files.push_back(file.string());
  Json stages = Json::object();
  for (const auto& [stage, seconds] : executor.times().stages()) stages[stage] = seconds;
  for (const auto& [stage, seconds] : before.stages()) stages[stage] = stages[stage].get<double>() - seconds;
  if (noise_left) stages["denoise"] = denoise_watch.seconds();
  send("done", {{"view", name},
                {"last", last},
                {"device", executor.facts().description},
                {"seconds", watch.seconds()},
                {"stages", std::move(stages)},
                {"rays", painted->rays},
                {"samples", scene_->image.samples},
                {"noise_left", noise_left ? Json(*noise_left) : Json()},
                {"doubts", doubts(view, *painted)},
                {"files", std::move(files)},
                {"processor_seconds", processor_seconds() - processor_seconds_}});
}

void RenderServer::send_rows(const std::string& name, const View& view, const PaintedRows& painted,
                             bool is_preview) {
  const image::Image& rows = painted.rows;
  Json json{{"view", name},
            {"width", scene_->image.width},
            {"height", scene_->image.height},
            {"row", painted.first},
            {"rows", rows.height()},
            {"stride", painted.stride},
            {"channels", rows.channels()},
            {"sample", painted.sample},
            {"preview", is_preview},
            {"processor_seconds", processor_seconds() - processor_seconds_}};
  if (view.aov) {
    json["shown_as"] = int(view.aov->shown_as);
  } else {
    // The first rows are those of a coarse picture, which is whole.
    if (!tone_) {
      tone_ = scene_->image.tone;
      if (scene_->image.meters) tone_->exposure = render::exposure_for(rows);
    }
    json["tone"] = {
        {"exposure", tone_->exposure}, {"curve", int(tone_->curve)}, {"white_balance", tone_->white_balance}};
  }
  send("rows", std::move(json),
       {reinterpret_cast<const char*>(rows.samples().data()), rows.sample_count() * sizeof(float)});
}

std::vector<std::string> RenderServer::doubts(const View& view, const Painted& painted) const {
  std::vector<std::string> doubts;
  for (const Diagnostic& each : session::warnings_of(painted.quality)) doubts.push_back(each.message);
  if (scene_->render.denoise && !scene_->is_mesh_alone && !obstacle_to_denoising_.empty())
    doubts.push_back(obstacle_to_denoising_);
  const std::string shaders = options_.executor.shader_folder.string();
  if (view.backend != executors::Backend::twin || shaders.empty()) return doubts;
  if (!options_.executor.twin.compile)
    doubts.push_back(
        fmt::format("this is the twin of eyeray's own shaders: to compile those of {}, install a C++ "
                    "compiler (c++, g++, clang++ or $CXX)",
                    shaders));
  else if (tunables_->any_chosen())
    doubts.push_back("the twin uses the values that are written in the shaders, not those of the sliders");
  return doubts;
}

void RenderServer::probe(const Json& request) {
  probe::Options options;
  options.x = request.value("x", 0);
  options.y = request.value("y", 0);
  Json answer{{"x", options.x}, {"y", options.y}};
  try {
    if (!scene_) throw Error(ExitCode::bad_input, "no scene is loaded yet");
    collect(longest_wait);
    options.executor = options_.executor;
    const probe::Findings findings = probe::probe_pixel(*scene_, options);
    answer["findings"] = Json::parse(probe::to_json(findings));
    answer["text"] = probe::to_text(findings, false);
  } catch (const std::exception& error) {
    answer["message"] = error.what();
  }
  send("probed", std::move(answer));
}

}  // namespace eyeray::engine::dev
