#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "benchmarks/bench/paths.hpp"
#include "benchmarks/bench/programs.hpp"
#include "benchmarks/bench/welch.hpp"
#include "benchmarks/contenders/cycles_scene.hpp"
#include "benchmarks/contenders/povray_scene.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"
#include "host/core/scratch_folder.hpp"
#include "host/image/image_file.hpp"
#include "host/loader/scene_file.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/photons.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::bench {
namespace {

constexpr int least_samples = 4;
constexpr int regions_a_side = 4;
constexpr double false_alarms = 1e-3;
constexpr double darkest = 0.01;  // added to the value that errors are relative to

// Photons blur by the square of their radius. The pictures that they are compared with have a sixteenth of
// that blur.
constexpr double reference_radius = 0.25;
constexpr int reference_samples = 4;  // as a multiple of those of the longest run
constexpr int reference_seeds[] = {1000001, 1000002};

// Two pictures of the same light, whose noise is independent of each other.
struct References {
  std::vector<float> a, b;
};

// The figures of a renderer's runs with one number of samples.
struct Pictures {
  std::vector<double> sum, sum_of_squares;  // over the runs, for each channel of each pixel
  std::vector<std::vector<double>>
      means;           // means of each region and channel, then of the picture, over the runs
  double squares = 0;  // squares of differences from the references, summed over the runs
  int runs = 0;

  // `references`: null where the error is the variance over the runs.
  void add(const image::Image& picture, const References* references) {
    const std::span<const float> samples = picture.samples();
    // The differences from two independent references are multiplied, so that the references' noise is not in
    // the mean.
    if (references)
      for (size_t i = 0; i < samples.size(); ++i)
        squares += (double(samples[i]) - double(references->a[i])) *
                   (double(samples[i]) - double(references->b[i])) / double(samples.size());
    sum.resize(samples.size());
    sum_of_squares.resize(samples.size());
    constexpr size_t all = regions_a_side * regions_a_side * 3;
    means.resize(all + 1);
    std::vector<double> total(all + 1), count(all + 1);
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const int region =
            y * regions_a_side / picture.height() * regions_a_side + x * regions_a_side / picture.width();
        for (int c = 0; c < 3; ++c) {
          const size_t i = (size_t(y) * size_t(picture.width()) + size_t(x)) * 3 + size_t(c);
          const double value = double(samples[i]);
          sum[i] += value;
          sum_of_squares[i] += value * value;
          for (const size_t at : {size_t(region) * 3 + size_t(c), all}) total[at] += value, count[at] += 1;
        }
      }
    }
    for (size_t i = 0; i <= all; ++i) means[i].push_back(count[i] > 0 ? total[i] / count[i] : 0);
    ++runs;
  }

  void errors(PathLevel& level, bool against_references) const {
    const double n = runs;
    if (against_references) level.error = std::max(0.0, squares / n);
    for (size_t i = 0; i < sum.size(); ++i) {
      const double mean = sum[i] / n;
      const double variance = n > 1 ? std::max(0.0, (sum_of_squares[i] - mean * sum[i]) / (n - 1)) : 0;
      if (!against_references) level.error += variance / double(sum.size());
      level.relative_error += variance / (mean * mean + darkest) / double(sum.size());
    }
  }
};

// A renderer that is measured.
struct Renderer {
  std::string name;
  std::function<TimedRun(int samples, int seed, const fs::path& output)> run;
  std::string_view ending;
  std::vector<std::vector<TimedRun>> runs;  // by level
  std::vector<Pictures> pictures;           // by level
};

PathSeries series_of(const Renderer& renderer, const std::vector<int>& levels,
                     bool against_references = false) {
  PathSeries series{renderer.name, renderer.runs.back().back().device, {}};
  for (size_t i = 0; i < levels.size(); ++i) {
    PathLevel level;
    level.samples = levels[i];
    level.rays = renderer.runs[i].back().rays;
    const auto spread_of = [&](const auto& figure) {
      std::vector<double> values;
      for (const TimedRun& run : renderer.runs[i]) values.push_back(figure(run));
      return spread(values);
    };
    level.seconds = spread_of([](const TimedRun& run) { return run.tracing; });
    level.processor = spread_of([](const TimedRun& run) { return run.tracing_processor; });
    level.whole_processor = spread_of([](const TimedRun& run) { return run.whole_processor; });
    renderer.pictures[i].errors(level, against_references);
    series.levels.push_back(level);
  }
  return series;
}

Likeness likeness_of(const Renderer& ours, const Renderer& theirs, bool judged) {
  const Pictures &a = ours.pictures.back(), &b = theirs.pictures.back();
  const size_t tests = a.means.size() - 1;
  const Moments mine = moments(a.means[tests]), other = moments(b.means[tests]);
  Likeness likeness;
  likeness.name = theirs.name;
  likeness.regions = int(tests / 3);
  likeness.ours = mine.mean;
  likeness.theirs = other.mean;
  likeness.standard_error = std::sqrt(mine.variance / mine.count + other.variance / other.count);
  likeness.threshold = 1 - std::pow(1 - false_alarms, 1.0 / double(tests));  // Šidák
  likeness.judged = judged;
  for (size_t i = 0; i < tests; ++i) {
    const Moments here = moments(a.means[i]), there = moments(b.means[i]);
    if (here.mean > 0) likeness.greatest = std::max(likeness.greatest, std::abs(there.mean / here.mean - 1));
    if (!judged) continue;
    const WelchTest test = welch(here, there);
    if (test.p > likeness.p) continue;
    likeness.p = test.p;
    likeness.t = test.t;
  }
  return likeness;
}

}  // namespace

PathReport measure_paths(const std::string& scene_file, const PathOptions& options) {
  std::vector<loader::Override> overrides;
  for (const std::string& define : options.defines) overrides.push_back({define});
  const Scene scene = loader::load_scene(scene_file, overrides);
  if (!walks_at_random(scene.render.integrator))
    throw Error(ExitCode::bad_input, "{} is not for path tracing: it says no [render] integrator = \"path\"",
                scene_file);
  const bool photons = sends_photons(scene.render.integrator);
  if (photons && (options.cycles || options.povray))
    throw Error(ExitCode::bad_input, "{} is of `sppm`, which is measured beside `path`, not beside others",
                scene_file);
  const ScratchFolder scratch;

  const auto eyeray_with = [&](const std::vector<std::string>& more) {
    return [&, more](int samples, int seed, const fs::path& output) {
      std::vector<std::string> words{scene_file,
                                     "--device",
                                     options.device,
                                     "--spp",
                                     std::to_string(samples),
                                     "--seed",
                                     std::to_string(seed),
                                     "-s",
                                     fmt::format("{}x{}", options.width, options.height)};
      for (const std::string& define : options.defines) words.insert(words.end(), {"-D", define});
      if (options.clamp > 0) words.insert(words.end(), {"--clamp", fmt::format("{}", options.clamp)});
      words.insert(words.end(), more.begin(), more.end());
      return run_render(words, output);
    };
  };
  std::vector<Renderer> renderers;
  if (photons) {
    renderers.push_back({"gpu, sppm", eyeray_with({}), ".pfm", {}, {}});
    renderers.push_back({"gpu, path", eyeray_with({"--integrator", "path"}), ".pfm", {}, {}});
  } else {
    renderers.push_back({"gpu", eyeray_with({"-D", "image.pattern=sobol"}), ".pfm", {}, {}});
    renderers.push_back({"gpu, random", eyeray_with({"-D", "image.pattern=random"}), ".pfm", {}, {}});
  }
  if (options.cycles) {
    check_blender();
    const fs::path script = scratch.path() / "scene.py";
    write_file_atomically(script, contenders::cycles_scene(scene, options.width, options.height));
    if (const auto environment = contenders::cycles_environment(scene))
      image::write_image(scratch.path() / contenders::cycles_environment_file, *environment);
    renderers.push_back({"Cycles",
                         [script](int samples, int seed, const fs::path& output) {
                           return run_cycles(script, samples, seed, output);
                         },
                         ".exr",
                         {},
                         {}});
  }

  std::vector<int> levels;
  for (int samples = least_samples; samples < options.most_samples; samples *= 4) levels.push_back(samples);
  levels.push_back(options.most_samples);
  std::optional<References> references;
  PathReport report{scene_file, options.width, options.height, options.runs, {}, {}};
  if (photons) {
    const double radius = reference_radius * photon_settings(scene).radius;
    const int samples = reference_samples * options.most_samples;
    const auto render = eyeray_with({"-D", fmt::format("render.photon_radius={}", radius)});
    references.emplace();
    for (std::vector<float>* const picture : {&references->a, &references->b}) {
      const fs::path output = scratch.path() / "reference.pfm";
      render(samples, reference_seeds[picture == &references->b], output);
      const image::Image read = image::read_image(output);
      picture->assign(read.samples().begin(), read.samples().end());
    }
    report.reference = fmt::format("two pictures by sppm of {} samples, within {:.3g}", samples, radius);
  }
  const References* const against = references ? &*references : nullptr;
  const auto run_once = [&](const Renderer& renderer, int samples, int seed, Pictures& pictures) {
    const fs::path output = scratch.path() / ("picture" + std::string(renderer.ending));
    fs::remove(output);
    TimedRun run = renderer.run(samples, seed, output);
    pictures.add(image::read_image(output), against);
    return run;
  };
  for (Renderer& renderer : renderers) {
    Pictures forgotten;
    run_once(renderer, 1, 1, forgotten);  // fills the caches
    renderer.runs.resize(levels.size());
    renderer.pictures.resize(levels.size());
  }
  // All renderers take turns, so that a change of the machine's speed affects them all.
  for (int seed = 1; seed <= options.runs; ++seed)
    for (size_t i = 0; i < levels.size(); ++i)
      for (Renderer& renderer : renderers)
        renderer.runs[i].push_back(run_once(renderer, levels[i], seed, renderer.pictures[i]));

  for (const Renderer& renderer : renderers)
    report.series.push_back(series_of(renderer, levels, references.has_value()));
  for (const Renderer& renderer : renderers)
    if (renderer.name == "Cycles") report.likeness.push_back(likeness_of(renderers.front(), renderer, true));
  if (options.povray) {
    check_povray();
    const fs::path file = scratch.path() / "scene.pov";
    write_file_atomically(file, contenders::povray_radiosity(scene, options.width, options.height));
    Renderer povray{"POV-Ray", {}, ".hdr", {{}}, {{}}};
    const fs::path output = scratch.path() / "povray.hdr";
    povray.runs[0].push_back(run_povray_radiosity(file, options.width, options.height, output));
    povray.pictures[0].add(image::read_image(output), nullptr);
    report.series.push_back(series_of(povray, {1}));
    report.likeness.push_back(likeness_of(renderers.front(), povray, false));
  }
  return report;
}

}  // namespace eyeray::engine::bench
