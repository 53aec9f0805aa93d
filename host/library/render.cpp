// Renderer::render: a scene becomes planes of floats.
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "host/core/disk_cache.hpp"
#include "host/library/engine_call.hpp"
#include "host/library/picture.hpp"
#include "host/library/renderer.hpp"
#include "host/library/scene.hpp"
#include "host/session/session.hpp"

namespace eyeray::engine::library {
namespace {

// A picture in memory.
class Planes final : public session::Output {
 public:
  explicit Planes(v0::Picture::Data& picture) : picture_(picture) {}

  void begin(const session::Plan& plan) override {
    crop_ = plan.crop;
    picture_.tone = plan.tone;
    for (const film::Channel each : plan.channels) picture_.aovs.emplace_back(each, image::Image());
    rows_.resize(1 + plan.channels.size());
  }

  void write(size_t plane, const image::Image& rows) override {
    image::Image& image = plane == 0 ? picture_.color : picture_.aovs[plane - 1].second;
    if (image.sample_count() == 0) image = image::Image(crop_.width, crop_.height, rows.channels());
    std::ranges::copy(rows.samples(), image.pixel(0, rows_[plane]));
    rows_[plane] += rows.height();
  }

  void finish_color() override {}

  void finish(const film::ChannelValues&, session::Result& result) override {
    if (result.interrupted())
      std::erase_if(picture_.aovs, [](const auto& each) { return !each.first->of_samples(); });
  }

 private:
  v0::Picture::Data& picture_;
  Rect crop_;
  std::vector<int> rows_;  // the number of rows that each plane has so far
};

session::Request request_of(const v0::RenderOptions& options) {
  session::Request request;
  request.backend = backend_of(options.backend);
  request.crop = rect_of(options.crop);
  if (!options.aovs.empty())
    request.channels = film::parse_channels(fmt::format("{}", fmt::join(options.aovs, ",")));
  request.noise = options.noise;
  request.clamp = options.clamp;
  request.reject_fireflies = options.reject_fireflies;
  request.denoise = options.denoise;
  request.denoiser =
      options.denoiser == v0::Denoiser::own ? session::Denoiser::own : session::Denoiser::open_image_denoise;
  request.next_is_alike = true;
  request.progress = progress_of(options.progress, options.cancellation);
  return request;
}

void render_into(v0::Picture::Data& picture, v0::Renderer::Data& renderer, const Scene& scene,
                 const v0::RenderOptions& options) {
  const session::Request request = request_of(options);
  session::Session session(executor_options(renderer, request.backend == executors::Backend::gpu));
  Planes planes(picture);
  session::Result result = session.render(scene, request, planes);
  picture.samples_done = result.totals.samples_done;
  picture.rays = result.totals.rays;
  picture.sampling_seconds = result.totals.seconds;
  picture.complete = !result.interrupted();
  picture.seconds = result.seconds;
  std::vector<Diagnostic> warnings;
  if (request.backend != executors::Backend::reference && !std::exchange(renderer.warned_of_caches, true))
    std::ranges::transform(DiskCache::of_user().warnings(), std::back_inserter(warnings), session::warning);
  std::ranges::move(result.warnings, std::back_inserter(warnings));
  picture.warnings = to_public(warnings);
}

}  // namespace
}  // namespace eyeray::engine::library

namespace eyeray::inline v0 {

Picture Renderer::render(const Scene& scene, const RenderOptions& options) {
  auto picture = std::make_shared<Picture::Data>();
  try {
    engine::library::call_renderer(*data_, options.cancellation, [&] {
      engine::library::render_into(*picture, *data_, scene.data().scene, options);
    });
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::cancelled) throw;
    picture->complete = false;
  }
  // Without a finished sample there are only some rows, which are no picture.
  if (picture->samples_done == 0) picture->color = {}, picture->aovs.clear();
  return Picture(std::move(picture));
}

}  // namespace eyeray::inline v0
