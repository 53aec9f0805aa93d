// Renderer::render: a scene becomes planes of floats.
#include "host/render/render.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "host/core/disk_cache.hpp"
#include "host/library/picture.hpp"
#include "host/library/renderer.hpp"
#include "host/library/scene.hpp"
#include "host/render/flags.hpp"
#include "host/render/shutter.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/sampler.hpp"

namespace eyeray::library {
namespace {

using aov::AovNeeds;

// Those that were named; of "all", those that the integrator has.
std::vector<aov::Aov> aovs_of(const v0::RenderOptions& options, const Scene& scene) {
  if (options.aovs.empty()) return {};
  std::vector<aov::Aov> aovs = aov::parse_aovs(fmt::format("{}", fmt::join(options.aovs, ",")));
  if (walks_at_random(scene.render.integrator) || !aov::any_needs(aovs, AovNeeds::auxiliary)) return aovs;
  if (aovs.size() != aov::aov_types().size())
    throw Error(ExitCode::bad_input,
                "the AOVs albedo and shading_normal are of paths: render.integrator=\"path\", or see normal");
  std::erase_if(aovs, [](aov::Aov each) { return each->needs == AovNeeds::auxiliary; });
  return aovs;
}

render::RenderOptions driver_options(const v0::RenderOptions& options, const Scene& scene,
                                     const std::vector<aov::Aov>& aovs) {
  if (!(options.noise >= 0 && options.noise <= 1) || !(options.clamp >= 0 && options.clamp <= 1e15))
    throw Error(ExitCode::bad_input, "noise is from 0 to 1, and clamp from 0 to 1e15");
  if (options.noise > 0 && sample_count_of(scene.image.pattern) != SampleCount::any)
    throw Error(ExitCode::bad_input,
                "noise stops after any number of samples, and of the pattern '{}' all are needed: "
                "image.pattern=\"sobol\" or \"random\"",
                sample_patterns[uint32_t(scene.image.pattern)]);
  render::RenderOptions driver;
  driver.crop = crop_of(options.crop, scene);
  driver.pixel_kinds = aov::any_needs(aovs, AovNeeds::ray_kinds);
  driver.pixel_noise = aov::any_needs(aovs, AovNeeds::noise);
  driver.pixel_brightest = aov::any_needs(aovs, AovNeeds::brightest);
  driver.pixel_auxiliary = aov::any_needs(aovs, AovNeeds::auxiliary);
  driver.noise = options.noise;
  driver.clamp = options.clamp;
  driver.progress = progress_of(options.progress, options.cancellation);
  return driver;
}

// One picture while it comes.
class Collector {
 public:
  Collector(const Scene& scene, const Rect& crop, std::vector<aov::Aov> aovs, v0::Picture::Data& picture)
      : scene_(scene), crop_(crop), picture_(picture) {
    for (const aov::Aov each : aovs) picture_.aovs.emplace_back(each, image::Image());
  }

  void take(const render::FinishedRows& rows) {
    copy(rows.color, rows.first, picture_.color);
    for (auto& [aov, image] : picture_.aovs)
      if (const auto* values = std::get_if<aov::ValuesOfRows>(&aov->values))
        copy((*values)(rows), rows.first, image);
  }

  // False when it was cancelled.
  bool trace_first_hits(executors::Executor& executor) {
    std::vector<std::unique_ptr<aov::LegendEntries>> entries;
    for (const auto& [aov, image] : picture_.aovs)
      entries.push_back(aov->is_of_first_hits() && aov->legend ? aov->legend(scene_) : nullptr);
    return render::trace_first_hits(executor, crop_, [&](int first, std::span<const FirstHit> hits) {
      for (const FirstHit& hit : hits) {
        flags |= hit.flags;
        flagged_hits += hit.flags != 0;
      }
      for (size_t i = 0; i < entries.size(); ++i) {
        auto& [aov, image] = picture_.aovs[i];
        if (aov->is_of_first_hits()) copy(aov_image(aov, hits, crop_.width, entries[i].get()), first, image);
      }
    });
  }

  uint32_t flags = 0;
  uint64_t flagged_hits = 0;

 private:
  void copy(const image::Image& rows, int first, image::Image& image) const {
    if (image.sample_count() == 0) image = image::Image(crop_.width, crop_.height, rows.channels());
    std::ranges::copy(rows.samples(), image.pixel(0, first));
  }

  const Scene& scene_;
  const Rect crop_;
  v0::Picture::Data& picture_;
};

void render_into(v0::Picture::Data& picture, v0::Renderer::Data& renderer, const Scene& scene,
                 const v0::RenderOptions& options) {
  const Stopwatch watch;
  picture.tone = scene.image.tone;
  const std::vector<aov::Aov> aovs = aovs_of(options, scene);
  const render::RenderOptions driver = driver_options(options, scene, aovs);
  const executors::Backend backend = backend_of(options.backend);
  executors::ExecutorOptions how = executor_options(renderer, backend == executors::Backend::gpu);
  how.ray_kinds = driver.pixel_kinds;
  // The next scene is likely one that differs in what moved.
  how.constants = executors::repay_kernels(scene.image.all_samples());
  how.search_cost = aov::any_needs(aovs, AovNeeds::search_cost);
  const auto executor = render::make_picture_executor(backend, scene, how);

  Collector collector(scene, driver.crop, aovs, picture);
  const render::RenderTotals totals = render::render_rows(
      scene, *executor, driver, [&](const render::FinishedRows& rows) { collector.take(rows); });
  picture.samples_done = totals.samples_done;
  picture.rays = totals.rays;
  picture.sampling_seconds = totals.seconds;
  picture.complete = !totals.interrupted;
  if (picture.complete && aov::need_first_hits(aovs))
    picture.complete = collector.trace_first_hits(*executor);
  if (!picture.complete)
    std::erase_if(picture.aovs, [](const auto& each) { return each.first->is_of_first_hits(); });
  std::vector<std::string> warnings;
  if (backend != executors::Backend::reference && !std::exchange(renderer.warned_of_caches, true))
    warnings = DiskCache::of_user().warnings();
  if (std::string flags = render::flag_warning(totals.flags | collector.flags,
                                               std::max(totals.flagged_pixels, collector.flagged_hits));
      !flags.empty())
    warnings.push_back(std::move(flags));
  picture.warning = fmt::format("{}", fmt::join(warnings, "\n"));
  picture.seconds = watch.seconds();
}

}  // namespace
}  // namespace eyeray::library

namespace eyeray::v0 {

Picture Renderer::render(const Scene& scene, const RenderOptions& options) {
  auto picture = std::make_shared<Picture::Data>();
  try {
    library::call_renderer(*data_, options.cancellation,
                           [&] { library::render_into(*picture, *data_, scene.data().scene, options); });
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::cancelled) throw;
    picture->complete = false;
  }
  // Rows of bands are no picture.
  if (picture->samples_done == 0) picture->color = {}, picture->aovs.clear();
  return Picture(std::move(picture));
}

}  // namespace eyeray::v0
