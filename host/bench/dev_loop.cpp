#include "host/bench/dev_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "host/bench/scratch_folder.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/embedded_shaders.hpp"
#include "host/core/error.hpp"
#include "host/core/make_folder.hpp"
#include "host/core/readable.hpp"
#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"
#include "host/dev/supervisor.hpp"

namespace eyeray::bench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* shader = "shapes/sphere.glsl";
constexpr const char* place = "float low = t0 < t1 ? t0 : t1;";
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

// The shader with other arithmetic in it: no cache knows it.
std::string edited_shader(int edit) {
  std::string text = text_of(shader);
  const size_t at = text.find(place);
  CHECK(at != std::string::npos);
  return text.insert(at + std::string_view(place).size(), fmt::format("\n  low *= 1.0f + {}e-7f;", edit));
}

class Loop {
 public:
  explicit Loop(int edits) : edits_(edits) {
    write(shader_file(), text_of(shader));
    write(scene_file(), scene_text(1.25));
    dev::SupervisorOptions options;
    options.worker = {"/proc/self/exe",           "dev",       scene_file(),     "--shaders",
                      folder_.path() / "shaders", "--no-page", "--worker-socket"};
    options.scene = scene_file();
    options.shader_folder = folder_.path() / "shaders";
    supervisor_.emplace(options, [this](const dev::Json& event) { take(event); });
  }

  DevLoopReport measure() {
    supervisor_->begin();
    wait();
    // Once each, so that what is made at the first edit of a kind is there.
    for (int i = 0; i <= edits_; ++i) add(i, report_.shader, shader_file(), edited_shader(salt_ + i));
    for (int i = 0; i <= edits_; ++i) add(i, report_.scene, scene_file(), scene_text(1.2 + 1e-4 * i));
    return report_;
  }

 private:
  std::string scene_file() const { return folder_.path() / "scene.toml"; }
  std::string shader_file() const { return folder_.path() / "shaders" / shader; }
  static void write(const fs::path& file, const std::string& text) {
    make_folder(file.parent_path());
    write_file_atomically(file, text);
  }

  void add(int number, std::vector<Edit>& edits, const std::string& file, const std::string& text) {
    edit_ = {};
    watch_ = {};
    write(file, text);
    wait();
    if (number > 0) edits.push_back(edit_);
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
    if (what == "rows" && edit_.first_pixels == 0) edit_.first_pixels = watch_.seconds();
    if (what == "failed")
      throw Error(ExitCode(event.value("code", 2)), "{}", event.value("message", std::string()));
    if (what != "done") return;
    done_ = true;
    edit_.whole = watch_.seconds();
    const dev::Json stages = event.value("stages", dev::Json::object());
    for (const char* stage : {"shader compile", "pipeline"}) edit_.compiling += stages.value(stage, 0.0);
    report_.device = event.value("device", "");
  }

  int edits_;
  int salt_ = int(::getpid() % 1000) * 1000;  // of this run
  ScratchFolder folder_;
  std::optional<dev::Supervisor> supervisor_;
  DevLoopReport report_;
  Edit edit_;
  Stopwatch watch_;
  bool done_ = false;
};

double median(const std::vector<Edit>& edits, double Edit::*what) {
  std::vector<double> values;
  for (const Edit& edit : edits) values.push_back(edit.*what);
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

}  // namespace

DevLoopReport measure_dev_loop(int edits) {
  return Loop(edits).measure();
}

std::string to_text(const DevLoopReport& report) {
  std::string text = fmt::format("{}\n{:<24}{:>14}{:>14}{:>14}{:>14}\n", report.device, "median of an edit",
                                 "first pixels", "compiling", "the rest", "all pixels");
  for (const auto& [name, edits] : {std::pair("a shader", &report.shader), {"the scene", &report.scene}}) {
    std::vector<Edit> rest = *edits;
    for (Edit& edit : rest) edit.compiling = edit.first_pixels - edit.compiling;
    text += fmt::format(
        "{:<24}{:>14}{:>14}{:>14}{:>14}\n", fmt::format("{} ({})", name, edits->size()),
        format_seconds(median(*edits, &Edit::first_pixels)), format_seconds(median(*edits, &Edit::compiling)),
        format_seconds(median(rest, &Edit::compiling)), format_seconds(median(*edits, &Edit::whole)));
  }
  return text;
}

nlohmann::ordered_json to_json(const DevLoopReport& report) {
  const auto list = [](const std::vector<Edit>& edits) {
    Json json = Json::array();
    for (const Edit& edit : edits)
      json.push_back(
          {{"first_pixels", edit.first_pixels}, {"compiling", edit.compiling}, {"whole", edit.whole}});
    return json;
  };
  return {{"device", report.device}, {"shader", list(report.shader)}, {"scene", list(report.scene)}};
}

}  // namespace eyeray::bench
