#include "host/session/request.hpp"

#include <algorithm>
#include <iterator>

#include "host/core/error.hpp"
#include "host/denoise/open_image_denoise.hpp"
#include "host/executors/formula_check.hpp"
#include "host/render/corners.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/sampler.hpp"

namespace eyeray::engine::session {
namespace {

constexpr int64_t most_denoised = int64_t{1} << 24;  // pixels, at 300 bytes each

void check_noise(const Request& request, const Scene& scene) {
  if (!(request.noise >= 0 && request.noise <= 1) || !(request.clamp >= 0 && request.clamp <= 1e15))
    throw Error(ExitCode::bad_input, "noise must be from 0 to 1, and clamp from 0 to 1e15");
  if (request.noise == 0) return;
  if (request.shard)
    throw Error(ExitCode::bad_input,
                "noise is measured from a pixel's neighbours, which are in other shards: leave out noise, so "
                "that all pixels have the same number of samples");
  if (sample_count_of(scene.image.pattern) != SampleCount::any)
    throw Error(ExitCode::bad_input,
                "noise stops after any number of samples, but the pattern '{}' needs all of them: set "
                "image.pattern to \"sobol\" or \"random\"",
                sample_patterns[uint32_t(scene.image.pattern)]);
}

void check_fireflies(const Request& request, const Scene& scene) {
  if (!request.reject_fireflies) return;
  if (!walks_at_random(scene.render.integrator))
    throw Error(ExitCode::bad_input,
                "only random paths make fireflies: set integrator = \"path\" in [render], or leave out "
                "reject-fireflies");
  if (request.shard)
    throw Error(ExitCode::bad_input,
                "fireflies are found from a pixel's neighbours, which are in other shards: leave out "
                "reject-fireflies");
}

void check_classic(const Request& request) {
  film::Channels has, lacks;
  for (const film::ChannelType& type : film::channel_types())
    if (type.of_corners != film::OfCorners::nothing) has.push_back(&type);
  std::ranges::copy_if(request.channels, std::back_inserter(lacks),
                       [&](film::Channel each) { return !film::contains(has, each); });
  if (!lacks.empty())
    throw Error(ExitCode::bad_input, "--classic samples pixel corners, so it lacks the AOVs {}; it has {}",
                film::channel_names(lacks), film::channel_names(has));
}

}  // namespace

Scene checked(Scene scene) {
  executors::check_formulas(scene);
  std::ranges::move(executors::doubt_lipschitz_constants(scene), std::back_inserter(scene.warnings));
  return scene;
}

Rect crop_within(const Rect& crop, const ImageSettings& image) {
  if (crop == Rect{}) return {0, 0, image.width, image.height};
  const bool inside = crop.x >= 0 && crop.y >= 0 && crop.width > 0 && crop.height > 0 &&
                      crop.x < image.width && crop.y < image.height && crop.width <= image.width - crop.x &&
                      crop.height <= image.height - crop.y;
  if (!inside)
    throw Error(ExitCode::bad_input, "the crop {},{},{},{} extends beyond the picture, which is {}x{}",
                crop.x, crop.y, crop.width, crop.height, image.width, image.height);
  return crop;
}

executors::ExecutorOptions counting(executors::ExecutorOptions options, const film::Channels& channels) {
  options.ray_kinds = film::any_needs(channels, film::Needs::ray_kinds);
  options.search_cost = film::any_needs(channels, film::Needs::search_cost);
  return options;
}

void make_classic(Scene& scene, Request& request) {
  request.classic = true;
  request.crop = crop_within(request.crop, scene.image);
  render::sample_corners(scene);
  scene.render.max_depth = 4;
  scene.render.min_throughput = 0;
}

film::Channels check(const Request& request, const Scene& scene) {
  if (request.classic) check_classic(request);
  check_noise(request, scene);
  check_fireflies(request, scene);
  crop_within(request.crop, scene.image);
  if (denoises(request, scene))
    if (const std::string obstacle = obstacle_to_denoising(request, scene); !obstacle.empty())
      throw Error(ExitCode::bad_input, "{}", obstacle);
  if (denoises(request, scene) && request.denoiser == Denoiser::open_image_denoise) denoise::check_for_oidn();
  return film::channels_of(scene, request.channels);
}

std::string obstacle_to_denoising(const Request& request, const Scene& scene) {
  if (!walks_at_random(scene.render.integrator))
    return "only pictures by random paths are denoised: set integrator = \"path\" in [render], or leave out "
           "denoise";
  if (scene.image.samples < 2)
    return "denoising compares the samples of a pixel, and this picture has one: set at least 2, such as "
           "--spp 16";
  if (const int64_t pixels = crop_within(request.crop, scene.image).pixels(); pixels > most_denoised)
    return fmt::format(
        "denoising has room for {} pixels, and this picture has {}: render crops of it, or leave out denoise",
        most_denoised, pixels);
  if (request.shard)
    return "a pixel is denoised from its neighbours, which are in other shards: leave out denoise";
  return "";
}

bool denoises(const Request& request, const Scene& scene) {
  return request.denoise ||
         (scene.render.denoise && (!scene.is_mesh_alone || obstacle_to_denoising(request, scene).empty()));
}

}  // namespace eyeray::engine::session
