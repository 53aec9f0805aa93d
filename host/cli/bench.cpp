// eyeray bench: rays a second beside Embree on the same rays, and how long whole pictures and their stages
// take beside POV-Ray. It measures; it never judges.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/bench/field_run.hpp"
#include "host/bench/standard_scenes.hpp"
#include "host/cli/bench_changes.hpp"
#include "host/cli/bench_pictures.hpp"
#include "host/cli/bench_runs.hpp"
#include "host/cli/command.hpp"
#include "host/cli/json.hpp"
#include "host/cli/scratch_folder.hpp"
#include "host/contenders/povray_scene.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/stopwatch.hpp"
#include "host/image/image_file.hpp"
#include "host/importers/import.hpp"
#include "host/loader/scene_file.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

constexpr std::string_view default_scene = "scenes/whitted.toml";

// More primitives would take POV-Ray gigabytes and a minute to parse.
constexpr uint64_t most_for_povray = 2'000'000;
// Of the standard scenes, whose pictures take half a minute each: made when asked for by name.
constexpr std::string_view large_scene = "terrain-8m";

// Our executors of a scene, by the names that they race under.
struct Ours {
  std::vector<std::unique_ptr<Executor>> executors;
  std::vector<Contender> contenders;
  std::vector<double> seconds;  // that making each took

  // What they spent on packing the scene, once they have raced: some of it is done when it is first needed.
  std::vector<Build> builds() const;
};

struct Command {
  std::vector<std::string> scenes;  // files, and names of standard scenes
  PictureOptions pictures;
  std::vector<std::string> incoherent{""};  // ProfileOptions::incoherent, each for a gpu executor of its own
  bool with_rays = true;
  bool with_pictures = true;
  std::string plot;
  std::string older;
  bool json = false;

  ExitCode run();

 private:
  Scene load(const std::string& name) const;
  Ours executors(const Scene& scene) const;
  SceneReport race_on(const std::string& name) const;
  Json render_all(const std::string& name) const;
};

// A file of that name comes first.
const StandardScene* as_standard(const std::string& name) {
  return fs::exists(name) ? nullptr : find_standard_scene(name);
}

Scene Command::load(const std::string& name) const {
  if (const StandardScene* const standard = as_standard(name)) return standard->make();
  std::vector<Override> overrides;
  for (const std::string& define : pictures.defines) overrides.push_back({define});
  return load_scene(name, overrides);
}

Ours Command::executors(const Scene& scene) const {
  Ours ours;
  const auto add = [&](const std::string& name, Backend backend, const std::string& how) {
    const Stopwatch watch;
    ExecutorOptions options;
    options.device = pictures.device;
    options.profile.incoherent = how;
    ours.executors.push_back(make_executor(backend, scene, options));
    ours.seconds.push_back(watch.seconds());
    Executor* const executor = ours.executors.back().get();
    ours.contenders.push_back(
        {name, ContenderKind::ours, [executor](const Batch& batch, std::span<QueryHit> hits) {
           return executor->query({batch.rays, batch.kind, batch.coherent}, hits);
         }});
  };
  for (const std::string& name : pictures.backends) {
    const Backend backend = parse_backend(name);
    if (backend == Backend::gpu)
      for (const std::string& how : incoherent) add(how.empty() ? name : name + " " + how, backend, how);
    else
      add(name, backend, "");
  }
  return ours;
}

std::vector<Build> Ours::builds() const {
  std::vector<Build> builds;
  for (size_t i = 0; i < executors.size(); ++i) {
    double packing = 0;
    for (const auto& [stage, spent] : executors[i]->times().stages())
      if (stage == "pack" || stage == "collapse") packing += spent;
    builds.push_back(
        {contenders[i].name, packing > 0 ? packing : seconds[i], executors[i]->geometry_bytes()});
  }
  return builds;
}

SceneReport Command::race_on(const std::string& name) const {
  const StandardScene* const standard = as_standard(name);
  const FieldOptions options{.width = pictures.width, .height = pictures.height, .runs = pictures.runs};
  const Scene scene = load(name);
  const Ours ours = executors(scene);
  SceneReport report =
      run_field(name, standard ? std::string(standard->family) : name, scene, options, ours.contenders);
  for (Build& build : ours.builds()) report.builds.push_back(std::move(build));
  if (!json) fmt::print("{}", to_text({report}));
  return report;
}

// The scene in POV-Ray's language; "" where that has not all of it, which is said.
std::string text_for_povray(const std::string& name, const Scene& scene, const PictureOptions& options) {
  try {
    return povray_scene(scene, options.width, options.height);
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_input) throw;
    fmt::print(stderr, "eyeray: {}: without POV-Ray: {}\n", name, error.what());
    return "";
  }
}

// A standard scene is written out first, for us; any that POV-Ray can have, for POV-Ray.
Json Command::render_all(const std::string& name) const {
  const StandardScene* const standard = as_standard(name);
  PictureOptions options = pictures;
  const ScratchFolder scratch;
  fs::path file = name;
  if (standard) {
    file = scratch.path() / (name + ".toml");
    standard->write(file);
  }
  {
    const Scene scene = load(name);  // gone before anything is measured
    options.primitives = scene.primitive_count();
    if (options.povray && have_povray() && options.primitives <= most_for_povray) {
      const std::string text = text_for_povray(name, scene, options);
      if (!text.empty()) {
        options.povray_scene = scratch.path() / "scene.pov";
        write_file_atomically(options.povray_scene, text);
      }
    }
  }
  return measure_pictures(name, file, options, !json);
}

ExitCode Command::run() {
  // Look at everything that may be wrong before measuring for minutes.
  for (const std::string& backend : pictures.backends) parse_backend(backend);
  if (!plot.empty()) check_writable(plot);
  const FieldReport old = older.empty() ? FieldReport() : read_field_report(older);
  const Json old_pictures = older.empty() ? Json::array() : read_older_pictures(older);
  const bool named = !scenes.empty();
  if (!named) {
    for (const StandardScene& standard : standard_scenes()) scenes.emplace_back(standard.name);
    if (fs::exists(default_scene)) scenes.emplace_back(default_scene);
  }
  for (const std::string& name : scenes) {
    if (!as_standard(name)) load(name);
  }

  FieldReport field;
  Json rendered = Json::array();
  for (const std::string& name : scenes) {
    if (with_rays) field.push_back(race_on(name));
    if (with_pictures && (named || name != large_scene)) rendered.push_back(render_all(name));
  }
  if (!plot.empty()) write_file_atomically(plot, to_svg(field));
  if (!older.empty() && !json) {
    const std::string changed = changes(old, field) + picture_changes(old_pictures, rendered);
    fmt::print("since {}:\n{}", older, changed.empty() ? "nothing in common\n" : changed);
  }
  if (json) print_json({{"bench", rendered}, {"field", to_json(field)}});
  return ExitCode::ok;
}

}  // namespace

void add_bench(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand("bench", "Measure rays a second and whole pictures.");
  const auto options = std::make_shared<Command>();
  PictureOptions& pictures = options->pictures;
  std::string names;
  for (const StandardScene& standard : standard_scenes())
    names += (names.empty() ? "" : ", ") + std::string(standard.name);
  command
      ->add_option("SCENE", options->scenes,
                   fmt::format("Scene files, or out of {}; all of these and {} when none is given.", names,
                               default_scene))
      ->option_text(" ");
  command->add_option("-n,--runs", pictures.runs, "Measured runs of each.")
      ->option_text("N=5")
      ->check(CLI::Range(1, 1000));
  command->add_option("--backends", pictures.backends, "Out of gpu, twin and reference.")
      ->option_text("LIST=gpu")
      ->delimiter(',')
      ->allow_extra_args(false);
  const auto parse = [options](const std::string& text) {
    std::tie(options->pictures.width, options->pictures.height) = parse_size(text);
    if (!image_size_allowed(options->pictures.width, options->pictures.height))
      throw Error(ExitCode::bad_input, "--size {}: a picture has 1 to 65536 pixels a side, 2^28 in all",
                  text);
  };
  command->add_option_function<std::string>("-s,--size", parse, "Picture size in pixels.")
      ->option_text("WxH=1024x1024");
  command->add_option("--spp", pictures.samples, "Samples a pixel of whole pictures.")
      ->option_text("N=1")
      ->check(CLI::Range(1, 65536));
  command->add_option("-D,--define", pictures.defines, "Lay a value over the scene files, as for render.")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--device", pictures.device, "As for render.")->option_text("WHICH");
  command
      ->add_option("--incoherent", options->incoherent,
                   "How gpu traces incoherent rays, out of cooperative (four lanes a ray), lanes and "
                   "packets: each races by itself.")
      ->option_text("LIST")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--scattered", options->incoherent)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->group("");  // until 0.2
  command->add_flag_callback(
      "--no-rays", [options] { options->with_rays = false; }, "Whole pictures only.");
  command->add_flag_callback(
      "--no-pictures", [options] { options->with_pictures = false; }, "Rays only.");
  command->add_flag_callback(
      "--no-povray", [options] { options->pictures.povray = false; },
      "Leave POV-Ray out, which else runs when installed, on SCENE.pov or what is written out for it.");
  command->add_flag_callback(
      "--no-start", [options] { options->pictures.start = false; }, "Leave cold and warm starts out.");
  command->add_option("--plot", options->plot, "Draw the rays a second, as an SVG picture.")
      ->option_text("FILE.svg");
  command->add_option("--compare", options->older, "Say what changed since an older answer of --json.")
      ->option_text("OLD.json");
  command->add_flag("--json", options->json, "Answer as JSON on standard output.");
  command->footer(
      "Rays: from the eye, to the light, and bounced once, on the same rays as Embree's, in turns.\n"
      "Pictures: every run is a process of its own, and contenders take turns. A cold start has empty "
      "caches;\n"
      "both starts go from nothing to a written 640x480 picture. bench/whitted.pov is that scene for "
      "POV-Ray;\n"
      "standard scenes and meshes are written out for it. What takes long is run once.\n"
      "Example: eyeray bench scenes/whitted.toml -n 9 --backends gpu,twin,reference\n"
      "         eyeray bench --no-pictures --plot rays.svg --json > rays.json");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::cli
