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
#include "host/render/legibility.hpp"
#include "host/render/shutter.hpp"
#include "host/render/warnings.hpp"
#include "host/scene/sampler.hpp"

namespace eyeray::library {
namespace {

// Those that were named; of "all", those that the integrator has.
film::Channels channels_wanted(const v0::RenderOptions& options, const Scene& scene) {
  if (options.aovs.empty()) return {};
  return film::channels_of(scene, film::parse_channels(fmt::format("{}", fmt::join(options.aovs, ","))));
}

render::RenderOptions driver_options(const v0::RenderOptions& options, const Scene& scene,
                                     const film::Channels& aovs) {
  if (!(options.noise >= 0 && options.noise <= 1) || !(options.clamp >= 0 && options.clamp <= 1e15))
    throw Error(ExitCode::bad_input, "noise is from 0 to 1, and clamp from 0 to 1e15");
  if (options.noise > 0 && sample_count_of(scene.image.pattern) != SampleCount::any)
    throw Error(ExitCode::bad_input,
                "noise stops after any number of samples, and of the pattern '{}' all are needed: "
                "image.pattern=\"sobol\" or \"random\"",
                sample_patterns[uint32_t(scene.image.pattern)]);
  render::RenderOptions driver;
  driver.crop = crop_of(options.crop, scene);
  driver.channels = aovs;
  driver.noise = options.noise;
  driver.clamp = options.clamp;
  driver.progress = progress_of(options.progress, options.cancellation);
  return driver;
}

// One picture while it comes.
class Collector {
 public:
  Collector(const Scene& scene, const Rect& crop, film::Channels aovs, v0::Picture::Data& picture)
      : scene_(scene), crop_(crop), picture_(picture) {
    for (const film::Channel each : aovs) picture_.aovs.emplace_back(each, image::Image());
  }

  void take(const film::Rows& rows) {
    copy(rows.color, rows.first, picture_.color);
    for (auto& [aov, image] : picture_.aovs)
      if (aov->of_samples()) copy(rows[aov], rows.first, image);
  }

  // False when it was cancelled.
  bool trace_first_hits(executors::Executor& executor) {
    std::vector<std::unique_ptr<film::LegendEntries>> entries;
    for (const auto& [aov, image] : picture_.aovs)
      entries.push_back(aov->legend ? aov->legend(scene_) : nullptr);
    return render::trace_first_hits(executor, crop_, [&](int first, std::span<const FirstHit> hits) {
      for (const FirstHit& hit : hits) {
        flags |= hit.flags;
        flagged_hits += hit.flags != 0;
      }
      for (size_t i = 0; i < entries.size(); ++i) {
        auto& [aov, image] = picture_.aovs[i];
        if (!aov->of_samples())
          copy(film::channel_image(aov, hits, crop_.width, entries[i].get()), first, image);
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
  const film::Channels aovs = channels_wanted(options, scene);
  const render::RenderOptions driver = driver_options(options, scene, aovs);
  const executors::Backend backend = backend_of(options.backend);
  executors::ExecutorOptions how = executor_options(renderer, backend == executors::Backend::gpu);
  how.ray_kinds = film::any_needs(aovs, film::Needs::ray_kinds);
  // The next scene is likely one that differs in what moved.
  how.constants = executors::repay_kernels(scene.image.all_samples());
  how.search_cost = film::any_needs(aovs, film::Needs::search_cost);
  const auto executor = render::make_picture_executor(backend, scene, how);

  Collector collector(scene, driver.crop, aovs, picture);
  render::Legibility legibility(scene.render.background, scene.image.tone.exposure);
  const render::RenderTotals totals =
      render::render_rows(scene, *executor, driver, [&](const film::Rows& rows) {
        collector.take(rows);
        legibility.see(rows.color);
      });
  picture.samples_done = totals.samples_done;
  picture.rays = totals.rays;
  picture.sampling_seconds = totals.seconds;
  picture.complete = !totals.interrupted;
  if (picture.complete && film::any_of_first_hits(aovs))
    picture.complete = collector.trace_first_hits(*executor);
  if (!picture.complete)
    std::erase_if(picture.aovs, [](const auto& each) { return !each.first->of_samples(); });
  std::vector<std::string> warnings;
  if (backend != executors::Backend::reference && !std::exchange(renderer.warned_of_caches, true))
    warnings = DiskCache::of_user().warnings();
  render::PictureQuality quality = render::quality_of(scene, driver, totals);
  quality.flags |= collector.flags;
  quality.flagged = std::max(quality.flagged, collector.flagged_hits);
  if (scene.is_mesh_alone && !scene.environment) quality.illegible = legibility.warning();
  std::ranges::move(render::warnings_of(quality), std::back_inserter(warnings));
  for (std::string& warning : warnings) picture.warnings.push_back({false, "", 0, 0, std::move(warning)});
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
