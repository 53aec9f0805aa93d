#include "host/dev/render_server.hpp"

#include <algorithm>

#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"
#include "host/probe/probe.hpp"
#include "host/render/sums.hpp"

namespace eyeray::dev {
namespace {

// How long a band of rows should take: what is seen grows so smoothly, and an edit waits so long.
constexpr double wanted_seconds = 0.04;
constexpr int first_pixels = 4096;  // of the first band

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

std::string bytes_of(const Image& image) {
  return {reinterpret_cast<const char*>(image.samples().data()), image.sample_count() * sizeof(float)};
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
  for (auto& executor : executors_) executor.reset();
  send("stage", {{"stage", "load"}});
  scene_ = options_.load(request.value("defines", std::vector<std::string>{}));
  revision_ = request.value("revision", int64_t{0});

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

void RenderServer::paint(const std::string& view, bool last) {
  const Stopwatch watch;
  const executors::Backend backend = executors::parse_backend(view);
  auto& executor = executors_[size_t(backend)];
  if (!executor) {
    send("stage", {{"stage", "compile"}});
    executor = executors::make_executor(backend, *scene_, options_.executor);
  }
  if (outdated()) return;
  send("stage", {{"stage", "render"}});

  const ImageSettings& image = scene_->image;
  render::PixelSums sums;
  sums.reset(image.width, image.height, false);
  std::vector<PixelSample> samples;
  uint64_t rays = 0, flagged = 0;
  uint32_t flags = 0;
  int band = std::clamp(first_pixels / image.width, 1, image.height);
  for (int sample = 0; sample < image.samples; ++sample) {
    for (int row = 0; row < image.height;) {
      if (outdated()) return;
      const Stopwatch band_watch;
      const int rows = std::min(band, image.height - row);
      samples.resize(size_t(rows) * size_t(image.width));
      if (!executor->sample({0, row, image.width, rows}, uint32_t(sample), samples)) return;
      sums.add(row, samples);
      for (const PixelSample& each : samples) {
        rays += each.rays;
        flags |= each.flags;
        flagged += each.flags != 0;
      }
      send("rows",
           {{"view", view},
            {"width", image.width},
            {"height", image.height},
            {"row", row},
            {"rows", rows},
            {"stride", 1},
            {"sample", sample}},
           bytes_of(sums.mean(row, rows, sample + 1, 0).color));
      row += rows;
      const double seconds = std::max(band_watch.seconds(), 1e-4);
      band = std::clamp(int(rows * std::min(wanted_seconds / seconds, 4.0)), 1, image.height);
    }
  }

  Json files = Json::array();
  for (const auto& file : executor->source_files()) files.push_back(file.string());
  Json stages = Json::object();
  for (const auto& [stage, seconds] : executor->times().stages()) stages[stage] = seconds;
  send("done", {{"view", view},
                {"last", last},
                {"device", executor->description()},
                {"seconds", watch.seconds()},
                {"stages", std::move(stages)},
                {"rays", rays},
                {"samples", image.samples},
                {"flags", flags},
                {"flagged_samples", flagged},
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
