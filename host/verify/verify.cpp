#include "host/verify/verify.hpp"

#include "host/core/stopwatch.hpp"
#include "host/executors/executors.hpp"
#include "host/executors/open_device.hpp"
#include "host/executors/shader_files.hpp"
#include "host/film/noisy_parts.hpp"
#include "host/raster/witness.hpp"
#include "host/reference/renderer.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/objects.hpp"
#include "host/verify/denoised.hpp"
#include "host/verify/evidence.hpp"
#include "host/verify/neighbours.hpp"
#include "host/verify/photon_judge.hpp"

namespace eyeray::engine::verify {
namespace {

// Limit on the kept samples of all pixels, so that those of one executor fit into some 400 MB.
constexpr size_t most_kept = size_t{1} << 24;

// Keeps the first samples of each pixel, in the order of Frame::samples.
auto sample_keeper(const Rect& area, int samples, std::vector<compare::TracedSample>& kept) {
  const size_t pixels = size_t(area.pixels()),
               each = std::clamp(most_kept / pixels, size_t{1}, size_t(samples));
  kept.resize(pixels * each);
  return [&kept, area, each](const Rect& tile, uint32_t index, std::span<const PixelSample> taken) {
    if (index >= each) return;
    for (size_t i = 0; i < taken.size(); ++i) {
      const size_t x = size_t(tile.x - area.x) + i % size_t(tile.width),
                   y = size_t(tile.y - area.y) + i / size_t(tile.width);
      const PixelSample& sample = taken[i];
      kept[(y * size_t(area.width) + x) * each + index] = {glm::vec3(sample.color), sample.trail, sample.hits,
                                                           sample.rays};
    }
  };
}

// Renders the scene by one executor, which becomes a participant of the report. `noisy`: gets the inputs of
// denoising; or null.
compare::Frame render_frame(executors::Backend backend, executors::Executor& executor, const Scene& scene,
                            const Options& options, std::function<void(const render::Progress&)> progress,
                            compare::Report& report, image::NoisyPicture* noisy = nullptr) {
  render::RenderOptions how;
  if (noisy) how.channels = film::with_noisy_parts({}, false);
  how.crop = options.crop;
  how.first_hits = true;
  how.over_white = true;
  how.progress = std::move(progress);
  std::vector<compare::TracedSample> samples;
  if (walks_at_random(scene.render.integrator))
    how.witness = sample_keeper(report.area, report.samples, samples);
  render::Rendering rendering = render::render(scene, executor, how);
  if (rendering.interrupted) throw Error(ExitCode::interrupted, "interrupted; nothing was decided");

  if (noisy) {
    noisy->color = rendering.color;
    for (const film::NoisyPart& part : film::noisy_parts(false))
      for (size_t i = 0; i < how.channels.size(); ++i)
        if (how.channels[i]->name == part.channel) noisy->*part.image = rendering.values[i];
  }

  compare::Frame frame;
  frame.area = report.area;
  frame.color = std::move(rendering.color);
  frame.first_hits = std::move(rendering.first_hits);
  frame.hits = std::move(rendering.hits);
  frame.rays_traced = std::move(rendering.rays_traced);
  frame.rays = rendering.rays;
  frame.flagged_pixels = rendering.flagged_pixels;
  frame.flags = rendering.flags;
  frame.samples = std::move(samples);
  compare::Participant& participant = report.participants.emplace_back(
      compare::Participant{std::string(executors::backend_name(backend)), executor.facts().description,
                           rendering.seconds, rendering.rays, compare::inspect(frame)});
  if (backend == executors::Backend::emulator) {
    participant.findings.emplace();
    for (const emulator::Finding& each : executor.facts().findings)
      participant.findings->push_back(emulator::describe(each));
  }
  return frame;
}

// Gate A: compares every executor of the shaders with the first of them.
void compare_backends(std::span<const compare::Frame> frames, const Options& options,
                      compare::Report& report) {
  for (size_t i = 1; i < options.backends.size(); ++i) {
    report.exact.push_back({report.participants[0].name, report.participants[i].name, options.ulp,
                            compare::compare_exactly(frames[0], frames[i])});
  }
}

// Gates B and C: compares every executor of the shaders with the reference, whose frame is the last. Returns
// each executor's outcomes, pixel by pixel.
std::vector<std::vector<compare::PixelOutcome>> compare_each_with_reference(
    std::span<const compare::Frame> frames, const compare::Reference& reference,
    const compare::PathReference* paths, const compare::Tolerances& tolerances, const Options& options,
    compare::Report& report) {
  const compare::Frame& reference_frame = frames.back();
  std::vector<std::vector<compare::PixelOutcome>> outcomes(options.backends.size());
  for (size_t i = 0; i < options.backends.size(); ++i) {
    const std::string& value = report.participants[i].name;
    // A picture that equals the first executor's bit by bit has the same result.
    if (i > 0 && report.exact[i - 1].comparison.passes(0)) {
      report.against_reference.push_back(report.against_reference[0]);
      report.against_reference.back().value = value;
      outcomes[i] = outcomes[0];
      continue;
    }
    compare::ReferenceResult result;
    result.value = value;
    result.tolerances = tolerances;
    result.comparison = compare::compare_with_reference(frames[i], reference_frame, reference, tolerances,
                                                        &outcomes[i], paths);
    if (result.comparison.incomparable.empty()) {
      result.metrics = compare::measure(frames[i].color, reference_frame.color);
      result.metrics->max_at.x += report.area.x;
      result.metrics->max_at.y += report.area.y;
    }
    report.against_reference.push_back(std::move(result));
  }
  return outcomes;
}

// True if the scene's denoised pictures are compared, too. Error (bad_input) if that was requested and cannot
// be.
bool denoises(const Scene& scene, const Options& options) {
  const bool possible = walks_at_random(scene.render.integrator) && scene.image.samples >= 2;
  if (options.denoise && !possible)
    throw Error(
        ExitCode::bad_input,
        "--denoise compares denoised pictures, which need integrator = \"path\" or \"sppm\" in [render] and "
        "2 samples a pixel or more");
  return options.denoise || (possible && scene.render.denoise && !scene.is_mesh_alone);
}

// Names the objects of the report's first hits, in the words of the scene.
void name_hits(const Scene& scene, compare::Report& report) {
  const Objects objects(scene);
  for (const FirstHit& hit : report.shown_hits()) {
    // An executor that fails may return anything.
    if (hit.primitive >= 0 && uint64_t(hit.primitive) < scene.primitive_count())
      report.primitives[hit.primitive] = objects.describe(uint64_t(hit.primitive));
    if (hit.material >= 0 && size_t(hit.material) < scene.materials.size()) {
      if (const std::string& name = scene.materials[size_t(hit.material)]->name; !name.empty())
        report.materials[hit.material] = fmt::format("\"{}\"", name);
    }
  }
}

// Draws the triangles that gate R compares with, on the device that renders.
std::optional<raster::Witness> draw(const Scene& scene, const Rect& area, const Options& options) {
  if (!options.raster) return std::nullopt;
  return std::make_optional<raster::Witness>(scene, area,
                                             executors::device_options(options.executor.gpu, false));
}

// Gate R: compares every executor, and the reference too, with the drawn triangles.
void compare_with_drawn(const raster::Witness& drawn, std::span<const compare::Frame> frames,
                        compare::Report& report) {
  for (size_t i = 0; i < frames.size(); ++i) {
    const std::string& value = report.participants[i].name;
    const bool same = i > 0 && i <= report.exact.size() && report.exact[i - 1].comparison.passes(0);
    report.raster.push_back(same ? report.raster[0] : drawn.compare(frames[i], value));
    report.raster.back().value = value;
  }
}

// The names of the executors in the report.
std::vector<std::string> names_of(const compare::Report& report) {
  std::vector<std::string> names;
  for (const compare::Participant& each : report.participants) names.push_back(each.name);
  return names;
}

}  // namespace

compare::Report verify_scene(const Subject& subject, const Options& options) {
  const Scene& scene = subject.scene;
  const Stopwatch watch;
  compare::Report report;
  report.scene = subject.file;
  report.options = subject.written_options;
  report.changed_shaders = executors::changed_shaders(options.executor.shader_folder);
  report.twin_has_changed_shaders = options.executor.twin.compile;
  report.width = scene.image.width;
  report.height = scene.image.height;
  report.area = options.crop == Rect{} ? Rect{0, 0, scene.image.width, scene.image.height} : options.crop;
  report.samples = scene.image.samples;

  const bool denoised = denoises(scene, options);
  std::vector<DenoisedFrame> denoised_frames;

  // Scenes that cannot be drawn are reported before anything is rendered.
  const std::optional<raster::Witness> drawn = draw(scene, report.area, options);

  // Render by each executor, last by the reference.
  std::vector<compare::Frame> frames;
  std::unique_ptr<executors::Twin> twin;
  executors::ExecutorOptions how = options.executor;
  const auto renderer = std::make_shared<const reference::Renderer>(scene, how.pack.acceleration);
  const auto reference_executor = executors::make_reference_executor(renderer);
  if (sends_photons(scene.render.integrator)) {
    const auto sender = executors::make_twin_executor(scene, how);
    JudgedPhotons judged =
        judge_photons(scene, [&](uint32_t index) { return sender->photon_ways(index); }, *renderer);
    how.left_out = std::move(judged.left_out);
    report.photons = std::move(judged.tally);
    renderer->tracer().leave_out(how.left_out);
  }
  const auto new_progress = [&] { return options.progress ? options.progress() : nullptr; };
  for (const executors::Backend backend : options.backends) {
    auto progress = new_progress();
    std::unique_ptr<executors::Executor> other;
    if (backend == executors::Backend::twin)
      twin = executors::make_twin_executor(scene, how);
    else
      other = executors::make_executor(backend, scene, how);
    executors::Executor& executor = other ? *other : *twin;
    image::NoisyPicture noisy;
    frames.push_back(render_frame(backend, executor, scene, options, std::move(progress), report,
                                  denoised ? &noisy : nullptr));
    if (denoised) denoised_frames.push_back(denoised_frame(std::move(noisy), executor, how));
  }
  frames.push_back(render_frame(executors::Backend::reference, *reference_executor, scene, options,
                                new_progress(), report));

  compare_backends(frames, options, report);
  const compare::Reference reference = neighbours(scene, *renderer);
  const compare::Tolerances tolerances{.max_explained =
                                           options.max_explained.value_or(scene.verify.max_explained)};
  const bool by_samples = walks_at_random(scene.render.integrator);
  if (by_samples && !twin) twin = executors::make_twin_executor(scene, how);
  const compare::PathReference paths = path_neighbours(scene, *renderer, twin.get());
  const auto outcomes = compare_each_with_reference(frames, reference, by_samples ? &paths : nullptr,
                                                    tolerances, options, report);
  report.denoised = compare_denoised(denoised_frames, names_of(report), report.area);
  if (drawn) compare_with_drawn(*drawn, frames, report);
  if (subject.golden) {
    report.golden = compare_with_golden(*subject.golden, scene, frames[0], reference, tolerances, report);
    bless(*subject.golden, scene, frames[0], report);
  }
  name_hits(scene, report);
  report.seconds = watch.seconds();
  if (!subject.evidence.empty() && (subject.keep_always || !report.passes())) {
    keep_evidence(subject.evidence, frames, outcomes, report);
    report.kept = subject.evidence.string();
  }
  if (options.witness) options.witness(report, frames, outcomes);
  return report;
}

}  // namespace eyeray::engine::verify
