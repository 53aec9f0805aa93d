#include "host/cli/identity.hpp"

#include "host/core/content_hash.hpp"
#include "host/core/host_arithmetic.hpp"
#include "host/program/build_facts.hpp"
#include "host/shards/part.hpp"

namespace eyeray::cli {

namespace {

// What decides the bits of every picture, whoever renders it.
std::vector<render::IdentityPart> identity_of_picture(const PictureRequest& request, const Scene& scene,
                                                      const executors::Executor& executor) {
  const Rect& crop = request.crop;
  return {
      {"size", fmt::format("{}x{}", scene.image.width, scene.image.height)},
      {"crop", crop == Rect{} ? "none" : fmt::format("{},{},{},{}", crop.x, crop.y, crop.width, crop.height)},
      {"--clamp", fmt::format("{}", request.clamp)},
      {"samples a pixel", std::to_string(scene.image.samples)},
      {"backend", std::string(executors::backend_name(request.backend))},
      {"scene", hash_of_files(scene.files), false},
      {"options laid over the scene", ContentHash().add(request.scene.as_written()).hex(), false},
      {"shaders of --shaders", hash_of_files(executor.source_files()), false},
      {"--fast-math", request.executor.fast_math ? "on" : "off"},
      {"version of eyeray", EYERAY_VERSION},
      {"sources of eyeray", std::string(sum_of_sources()), false},
  };
}

}  // namespace

std::vector<render::IdentityPart> identity_of(const PictureRequest& request, const Scene& scene,
                                              const executors::Executor& executor) {
  std::vector<render::IdentityPart> identity = identity_of_picture(request, scene, executor);
  const bool gpu = request.backend == executors::Backend::gpu;
  film::Channels summed = request.aovs;
  std::erase_if(summed, [](film::Channel each) { return !each->of_samples(); });
  const std::vector<render::IdentityPart> more{
      {"--shard", request.shard ? shards::shard_text(*request.shard) : "none"},
      {"--classic", request.classic ? "on" : "off"},
      {"AOVs of samples", film::channel_names(summed)},
      {"--noise", std::to_string(request.noise)},
      // The processors' executors compute the same wherever the same program runs.
      {"device", gpu ? executor.description() : "none"},
      {"--band-memory", std::to_string(request.long_render.band_mebibytes)},
  };
  identity.insert(identity.end(), more.begin(), more.end());
  return identity;
}

std::vector<render::IdentityPart> identity_of_parts(const PictureRequest& request, const Scene& scene,
                                                    const executors::Executor& executor) {
  std::vector<render::IdentityPart> identity = identity_of_picture(request, scene, executor);
  identity.push_back({"AOVs", film::channel_names(request.aovs)});
  identity.push_back({"arithmetic of the device", executor.arithmetic()});
  identity.push_back({"arithmetic of the C library", host_arithmetic(), false});
  return identity;
}

}  // namespace eyeray::cli
