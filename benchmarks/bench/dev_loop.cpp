#include "benchmarks/bench/dev_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "benchmarks/bench/programs.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/embedded_shaders.hpp"
#include "host/core/error.hpp"
#include "host/core/make_folder.hpp"
#include "host/core/readable.hpp"
#include "host/core/scratch_folder.hpp"
#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"
#include "host/dev/supervisor.hpp"

namespace eyeray::engine::bench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* shader = "shapes/sphere.glsl";
constexpr const char* insertion_point = "float low = t0 < t1 ? t0 : t1;";
constexpr double patience = 60;  // seconds, for one edit

std::string scene_text(double radius) {
  return fmt::format(R"([image]
width = 640
height = 480

[camera]
eye = [8, 2, -4]
target = [4, 2.3, -4]
fov = 60

[render]
integrator = "whitted"
background = [0.34, 0.55, 0.85]

[[light]]
type = "point"
position = [8, 10, 3]
intensity = [60, 60, 60]

[[material]]
name = "glass"
type = "dielectric"
ior = 1.4

[[material]]
name = "floor"
type = "phong"
diffuse = {{ checker = {{ even = [0.8, 0.3, 0.15], odd = [0.9, 0.85, 0.05], size = 1 }} }}

[[sphere]]
center = [4, 2.3, -4]
radius = {:.9g}
material = "glass"

[[sphere]]
center = [2, 1.6, -5.5]
radius = 0.8
material = "floor"

[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "floor"
)",
                     radius);
}

std::string text_of(std::string_view name) {
  for (const EmbeddedFile& each : embedded_shaders())
    if (each.name == name) return std::string(each.text);
  throw Error(ExitCode::bad_input, "no shader {}", name);
}

// The shader with arithmetic that differs for each `edit`, so that no cache contains it.
std::string edited_shader(int edit) {
  std::string text = text_of(shader);
  const size_t at = text.find(insertion_point);
  CHECK(at != std::string::npos);
  return text.insert(at + std::string_view(insertion_point).size(),
                     fmt::format("\n  low *= 1.0f + {}e-7f;", edit));
}

// A column on a floor. Its formula has different operations for each `edit`, so no kernel exists for it.
std::string formula_text(int edit) {
  std::string operations;
  for (int bit = 0; bit < 20; ++bit) operations += (edit >> bit & 1) ? "  e *= p.y;\n" : "  e += p.y;\n";
  return fmt::format(R"([image]
width = 480
height = 320
samples = 4

[camera]
eye = [1.9, 2.3, 4.6]
target = [0, 0.7, 0]
fov = 44

[render]
background = [0.66, 0.76, 0.86]
ambient = 0.3
max_depth = 3

[[light]]
type = "point"
position = [2.5, 5, 4.5]
intensity = 44

[[material]]
name = "clay"
type = "phong"
diffuse = [0.75, 0.36, 0.2]
specular = 0.35
reflectance = 0.12

[[disk]]
center = [0, 0, 0]
normal = [0, 1, 0]
radius = 2
material = "clay"

[[implicit]]
code = """float f(vec3 p) {{
  float e = p.x;
{}  float c = cos(1.5 * p.y);
  float s = sin(1.5 * p.y);
  vec3 q = vec3(c * p.x - s * p.z, p.y - 0.8, s * p.x + c * p.z);
  vec3 beyond = abs(q) - vec3(0.28, 0.68, 0.28);
  return length(max(beyond, 0.0)) - 0.12 + 1e-12 * clamp(e, -1.0, 1.0);
}}"""
min = [-0.7, 0, -0.7]
max = [0.7, 1.7, 0.7]
lipschitz = 2.2
material = "clay"
)",
                     operations);
}

// A dev loop of a scene, and of a shader unless `shader_text` is empty.
class Loop {
 public:
  Loop(const std::string& scene, const std::string& shader_text) {
    write(scene_file(), scene);
    dev::SupervisorOptions options;
    options.worker = {eyeray_program(), "dev", scene_file(), "--no-page", "--worker-socket"};
    options.scene = scene_file();
    if (!shader_text.empty()) {
      write(shader_file(), shader_text);
      options.shader_folder = folder_.path() / "shaders";
      options.worker.insert(options.worker.end() - 1, {"--shaders", options.shader_folder});
    }
    supervisor_.emplace(options, [this](const dev::Json& event) { take(event); });
    supervisor_->begin();
    wait();
  }

  std::string scene_file() const { return folder_.path() / "scene.toml"; }
  std::string shader_file() const { return folder_.path() / "shaders" / shader; }
  const std::string& device() const { return device_; }

  // Makes `count` edits of a file and measures each. One edit before them fills the caches.
  std::vector<Edit> measure(int count, const std::string& file, const std::function<std::string(int)>& text) {
    std::vector<Edit> edits;
    for (int i = 0; i <= count; ++i) {
      edit_ = {};
      watch_ = {};
      write(file, text(i));
      wait();
      if (i > 0) edits.push_back(edit_);
    }
    return edits;
  }

 private:
  static void write(const fs::path& file, const std::string& text) {
    make_folder(file.parent_path());
    write_file_atomically(file, text);
  }

  void wait() {
    done_ = false;
    for (const Stopwatch since; !done_;) {
      stop_if_interrupted();
      if (since.seconds() > patience)
        throw Error(ExitCode::timed_out, "no picture {} after an edit", format_seconds(patience));
      supervisor_->step();
    }
  }

  void take(const dev::Json& event) {
    const std::string what = event.value("event", "");
    const double processor = event.value("processor_seconds", 0.0);
    if (what == "rows" && edit_.first_pixels == 0) {
      edit_.first_pixels = watch_.seconds();
      edit_.first_processor = processor;
    }
    if (what == "failed")
      throw Error(ExitCode(event.value("code", 2)), "{}", event.value("message", std::string()));
    if (what != "done") return;
    done_ = true;
    edit_.whole = watch_.seconds();
    edit_.processor = processor;
    const dev::Json stages = event.value("stages", dev::Json::object());
    for (const char* stage : {"shader compile", "pipeline"}) edit_.compiling += stages.value(stage, 0.0);
    device_ = event.value("device", "");
  }

  ScratchFolder folder_;
  std::optional<dev::Supervisor> supervisor_;
  std::string device_;
  Edit edit_;
  Stopwatch watch_;
  bool done_ = false;
};

double median(const std::vector<Edit>& edits, double Edit::* what) {
  std::vector<double> values;
  for (const Edit& edit : edits) values.push_back(edit.*what);
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

}  // namespace

DevLoopReport measure_dev_loop(int edits) {
  const int salt = int(::getpid() % 1000) * 1000;  // differs between runs
  DevLoopReport report;
  Loop whitted(scene_text(1.25), text_of(shader));
  report.device = whitted.device();
  report.shader =
      whitted.measure(edits, whitted.shader_file(), [&](int i) { return edited_shader(salt + i); });
  report.scene =
      whitted.measure(edits, whitted.scene_file(), [](int i) { return scene_text(1.2 + 1e-4 * i); });
  Loop column(formula_text(salt), "");
  report.formula =
      column.measure(edits, column.scene_file(), [&](int i) { return formula_text(salt + 1 + i); });
  return report;
}

std::string to_text(const DevLoopReport& report) {
  std::string text =
      fmt::format("{}\n{:<18}{:>14}{:>14}{:>14}{:>14}{:>14}\n", report.device, "median of an edit",
                  "first pixels", "of processors", "compiling", "all pixels", "of processors");
  for (const auto& [name, edits] : {std::pair("a shader", &report.shader),
                                    {"the scene", &report.scene},
                                    {"a formula", &report.formula}}) {
    text += fmt::format("{:<18}", fmt::format("{} ({})", name, edits->size()));
    for (const auto what :
         {&Edit::first_pixels, &Edit::first_processor, &Edit::compiling, &Edit::whole, &Edit::processor})
      text += fmt::format("{:>14}", format_seconds(median(*edits, what)));
    text += '\n';
  }
  return text;
}

nlohmann::ordered_json to_json(const DevLoopReport& report) {
  const auto list = [](const std::vector<Edit>& edits) {
    Json json = Json::array();
    for (const Edit& edit : edits)
      json.push_back({{"first_pixels", edit.first_pixels},
                      {"first_processor", edit.first_processor},
                      {"compiling", edit.compiling},
                      {"whole", edit.whole},
                      {"processor", edit.processor}});
    return json;
  };
  return {{"device", report.device},
          {"shader", list(report.shader)},
          {"scene", list(report.scene)},
          {"formula", list(report.formula)}};
}

}  // namespace eyeray::engine::bench
