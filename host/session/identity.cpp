#include "host/session/identity.hpp"

#include "host/build/build_facts.hpp"
#include "host/core/content_hash.hpp"
#include "host/core/host_arithmetic.hpp"
#include "host/shards/part.hpp"

namespace eyeray::engine::session {

namespace {

// The facts that decide the bits of every picture, on any machine.
std::vector<render::IdentityPart> identity_of_picture(const Plan& plan) {
  const Request& request = plan.request;
  const Scene& scene = plan.scene;
  const Rect& crop = request.crop;
  return {
      {"size", fmt::format("{}x{}", scene.image.width, scene.image.height)},
      {"crop", crop == Rect{} ? "none" : fmt::format("{},{},{},{}", crop.x, crop.y, crop.width, crop.height)},
      {"--clamp", fmt::format("{}", request.clamp)},
      {"--reject-fireflies", request.reject_fireflies ? "on" : "off"},
      {"samples a pixel", std::to_string(scene.image.samples)},
      {"backend", std::string(executors::backend_name(request.backend))},
      {"scene", hash_of_files(scene.files), false},
      {"options laid over the scene", ContentHash().add(request.overrides).hex(), false},
      {"shaders of --shaders", hash_of_files(plan.executor.facts().source_files), false},
      {"--fast-math", plan.fast_math ? "on" : "off"},
      {"version of eyeray", std::string(build::version())},
      {"sources of eyeray", std::string(build::sum_of_sources()), false},
  };
}

}  // namespace

std::vector<render::IdentityPart> identity_of_checkpoint(const Plan& plan) {
  const Request& request = plan.request;
  std::vector<render::IdentityPart> identity = identity_of_picture(plan);
  const bool gpu = request.backend == executors::Backend::gpu;
  film::Channels summed = plan.channels;
  std::erase_if(summed, [](film::Channel each) { return !each->of_samples(); });
  const std::vector<render::IdentityPart> more{
      {"--shard", request.shard ? shards::shard_text(*request.shard) : "none"},
      {"--classic", request.classic ? "on" : "off"},
      {"AOVs of samples", film::channel_names(summed)},
      {"--noise", std::to_string(request.noise)},
      // Executors on the CPU compute the same bits on every machine that runs the same program.
      {"device", gpu ? plan.executor.facts().description : "none"},
      {"--band-memory", std::to_string(request.band_bytes >> 20)},
  };
  identity.insert(identity.end(), more.begin(), more.end());
  return identity;
}

std::vector<render::IdentityPart> identity_of_part(const Plan& plan) {
  std::vector<render::IdentityPart> identity = identity_of_picture(plan);
  identity.push_back({"AOVs", film::channel_names(plan.channels)});
  identity.push_back({"arithmetic of the device", plan.executor.facts().arithmetic});
  identity.push_back({"arithmetic of the C library", host_arithmetic(), false});
  return identity;
}

}  // namespace eyeray::engine::session
