// eyeray verify: renders a scene by every executor and compares them, gate by gate (docs/verification.md).
#include <algorithm>
#include <bit>

#include "host/cli/command.hpp"
#include "host/cli/evidence.hpp"
#include "host/cli/within.hpp"
#include "host/compare/report.hpp"
#include "host/executors/executors.hpp"
#include "host/reference/renderer.hpp"
#include "host/scene/objects.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

struct Command {
  SceneOptions scene_options;
  std::vector<std::string> more_scenes;
  std::vector<Backend> backends{Backend::gpu, Backend::twin};
  ExecutorOptions executor;
  Rect crop;
  Tolerances tolerances;
  int64_t ulp = 0;
  std::string keep;
  bool quiet = false;
  bool json = false;

  ExitCode run() const;
  Report verify(const SceneOptions& options) const;
  Frame render_frame(Backend backend, Executor& maker, const Scene& scene, Report& report) const;
  fs::path folder_for(const std::string& scene) const;
};

// "gpu,twin".
std::vector<Backend> parse_backends(const std::string& list) {
  std::vector<Backend> backends;
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    const Backend backend = parse_backend(list.substr(begin, end - begin));
    begin = end + 1;
    if (backend == Backend::reference) {
      throw Error(ExitCode::bad_input,
                  "--backends names what is compared with the reference: gpu, twin or gpu,twin");
    }
    if (std::find(backends.begin(), backends.end(), backend) == backends.end()) backends.push_back(backend);
  }
  return backends;
}

uint64_t mix(uint64_t hash, uint64_t value) {
  return (hash ^ value) * 0x9e3779b97f4a7c15u + std::rotl(hash, 23);
}

// Adds to a probe's fingerprints what one sample's eye ray hits.
void add_first_hit(Probe& probe, const Scene& scene, const FirstHit& hit) {
  probe.first_surfaces = mix(probe.first_surfaces, uint64_t(hit.primitive));
  if (hit.primitive < 0) return;
  const Vec3 color = scene.materials[size_t(hit.material)]->base_color(hit.uv);
  for (int c = 0; c < 3; ++c) probe.first_colors = mix(probe.first_colors, std::bit_cast<uint64_t>(color[c]));
}

// How far off surfaces, and at most aside, float32 rays start: of a triangle, 8 ε for each of its three
// vertices (docs/numerics.md).
constexpr double float32_ray_offset = 24 * 0x1p-24;

// All samples of pixel (x, y), every ray moved by `shift`.
Probe probe(const Scene& scene, const reference::Renderer& renderer, int x, int y, const Vec2& shift) {
  Probe result;
  const auto seed = uint32_t(mix(std::bit_cast<uint64_t>(shift.x), std::bit_cast<uint64_t>(shift.y)) >> 32);
  for (int i = 0; i < scene.image.samples; ++i) {
    const PixelSample sample = renderer.sample(x, y, uint32_t(i), shift);
    result.color += sample.color / double(scene.image.samples);
    result.sample_colors.push_back(sample.color);
    using reference::TextureChoice;
    const auto add_rounded = [&](bool along_normal, TextureChoice textures) {
      const reference::RayOffset ray_offset{float32_ray_offset, along_normal, seed, textures};
      result.rounded_colors.push_back(renderer.sample(x, y, uint32_t(i), shift, ray_offset).color);
    };
    for (const bool along_normal : {false, true}) add_rounded(along_normal, TextureChoice::at_hit);
    if (shift == Vec2(0.0))
      for (const auto textures : {TextureChoice::darkest, TextureChoice::brightest})
        add_rounded(false, textures);
    result.hits += sample.hits;
    result.direct = result.direct && sample.hits <= 1;
    const Vec2 place = reference::sample_position(scene.image, scene.render.seed, x, y, uint32_t(i));
    add_first_hit(result, scene, renderer.first_hit(x, y, place - 0.5 + shift));
  }
  result.hits_per_sample = double(result.hits) / scene.image.samples;
  result.first_hit = renderer.first_hit(x, y, shift);
  result.rounding = renderer.rounding(x, y, result.first_hit.t);
  return result;
}

// Says what the report's first hits hit, in the words of the scene.
void name_hits(const Scene& scene, Report& report) {
  const Objects things(scene);
  for (const FirstHit& hit : report.shown_hits()) {
    // An executor that fails may say anything.
    if (hit.primitive >= 0 && uint64_t(hit.primitive) < scene.primitive_count())
      report.primitives[hit.primitive] = things.describe(uint64_t(hit.primitive));
    if (hit.material >= 0 && size_t(hit.material) < scene.materials.size()) {
      if (const std::string& name = scene.materials[size_t(hit.material)]->name; !name.empty())
        report.materials[hit.material] = fmt::format("\"{}\"", name);
    }
  }
}

Frame Command::render_frame(Backend backend, Executor& maker, const Scene& scene, Report& report) const {
  Rendering rendering = render(scene, maker, {crop, true, progress_reporter(quiet)});
  if (rendering.interrupted) throw Error(ExitCode::interrupted, "interrupted; nothing was decided");

  Frame frame;
  frame.area = report.area;
  frame.color = std::move(rendering.color);
  frame.first_hits = std::move(rendering.first_hits);
  frame.hits = std::move(rendering.hits);
  frame.rays = rendering.rays;
  frame.flagged_pixels = rendering.flagged_pixels;
  frame.flags = rendering.flags;
  report.participants.push_back({std::string(backend_name(backend)), maker.description(), rendering.seconds,
                                 rendering.rays, inspect(frame)});
  return frame;
}

fs::path Command::folder_for(const std::string& scene) const {
  const std::string stem = fs::path(scene).stem().string();
  if (keep.empty()) return stem + ".verify";
  return more_scenes.empty() ? fs::path(keep) : fs::path(keep) / stem;
}

Report Command::verify(const SceneOptions& options) const {
  const Scene scene = options.load();
  check_crop(crop, scene.image);
  Report report;
  report.scene = options.file();
  report.options = options.as_written();
  report.width = scene.image.width;
  report.height = scene.image.height;
  report.area = crop == Rect{} ? Rect{0, 0, scene.image.width, scene.image.height} : crop;
  report.samples = scene.image.samples;

  // Render, the reference last.
  std::vector<Frame> frames;
  for (const Backend backend : backends)
    frames.push_back(render_frame(backend, *make_executor(backend, scene, executor), scene, report));
  const auto renderer = std::make_shared<const reference::Renderer>(scene, executor.pack.acceleration);
  frames.push_back(render_frame(Backend::reference, *make_reference_executor(renderer), scene, report));
  const Frame& reference_frame = frames.back();

  // Gate A: every executor of the shaders with the first of them.
  for (size_t i = 1; i < backends.size(); ++i) {
    report.exact.push_back({report.participants[0].name, report.participants[i].name, ulp,
                            compare_exactly(frames[0], frames[i])});
  }

  // Gates B and C.
  const Reference reference = [&](int x, int y, const Vec2& shift) {
    return probe(scene, *renderer, x, y, shift);
  };
  for (size_t i = 0; i < backends.size(); ++i) {
    ReferenceResult result;
    result.value = report.participants[i].name;
    result.tolerances = tolerances;
    result.comparison = compare_with_reference(frames[i], reference_frame, reference, tolerances);
    if (result.comparison.incomparable.empty()) {
      result.metrics = measure(frames[i].color, reference_frame.color);
      result.metrics->max_at.x += report.area.x;
      result.metrics->max_at.y += report.area.y;
    }
    report.against_reference.push_back(std::move(result));
  }

  name_hits(scene, report);
  if (!report.passes()) {
    const fs::path folder = folder_for(report.scene);
    keep_evidence(folder, frames, report);
    report.kept = folder.string();
  }
  return report;
}

ExitCode Command::run() const {
  std::vector<std::string> files{scene_options.file()};
  files.insert(files.end(), more_scenes.begin(), more_scenes.end());

  std::vector<Report> reports;
  for (const std::string& file : files) {
    reports.push_back(verify(scene_options.for_file(file)));
    if (!json) fmt::print("{}", to_text(reports.back()));
  }
  if (json) {
    fmt::print("{}", to_json(reports));
  } else if (reports.size() > 1) {
    fmt::print("{}", summary(reports));
  }
  const bool passed = std::all_of(reports.begin(), reports.end(), [](const Report& r) { return r.passes(); });
  return passed ? ExitCode::ok : ExitCode::comparison_failed;
}

}  // namespace

void add_verify(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand(
      "verify", "Check the GPU's pixels against the CPU, bit by bit and against the reference.");
  const auto options = std::make_shared<Command>();
  options->scene_options.add_to(*command);
  command->add_option("MORE", options->more_scenes, "Further scenes, under the same options.")
      ->option_text(" ");
  add_crop_option(*command, options->crop);
  add_executor_options(*command, options->executor);
  const auto parse = [options = options.get()](const std::string& list) {
    options->backends = parse_backends(list);
  };
  command->add_option_function<std::string>("--backends", parse, "What is compared with the reference.")
      ->option_text("LIST=gpu,twin")
      ->group("Device");
  command
      ->add_option("--max-explained", options->tolerances.max_explained,
                   "The share of pixels that may differ where the picture itself jumps.")
      ->option_text(fmt::format("SHARE={}", options->tolerances.max_explained))
      ->check(within(0, 0.05));
  command
      ->add_option(
          "--ulp", options->ulp,
          "How far GPU and twin may be apart, in units in the last place: for devices whose square root or "
          "division is not exact.")
      ->option_text("N=0")
      ->check(CLI::Range(0, 64));
  command
      ->add_option("--keep", options->keep,
                   "Where pictures are left when a gate fails. Default: SCENE.verify here.")
      ->option_text("DIR");
  command->add_flag("-q,--quiet", options->quiet, "No progress.");
  command->add_flag("--json", options->json, "Report as JSON.");
  command->footer(
      "Examples:\n"
      "  eyeray verify scenes/whitted.toml\n"
      "  eyeray verify scenes/*.toml -s 96x72 --json\n"
      "Exit code 0 when every gate passes, 1 when one fails, 6 when a scene could not be verified for want "
      "of a C++ "
      "compiler.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::cli
