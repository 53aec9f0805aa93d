#include "host/cli/identity.hpp"

#include <array>

#include "host/core/content_hash.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {

std::vector<render::IdentityPart> identity_of(const PictureRequest& request, const Scene& scene,
                                              const executors::Executor& executor) {
  const Rect& crop = request.crop;
  const bool gpu = request.backend == executors::Backend::gpu;
  return {
      {"size", fmt::format("{}x{}", scene.image.width, scene.image.height)},
      {"crop", crop == Rect{} ? "none" : fmt::format("{},{},{},{}", crop.x, crop.y, crop.width, crop.height)},
      {"--classic", request.classic ? "on" : "off"},
      {"--aov of kinds of rays", aov::any_needs(request.aovs, aov::AovNeeds::ray_kinds) ? "on" : "off"},
      {"--aov noise", aov::any_needs(request.aovs, aov::AovNeeds::noise) ? "on" : "off"},
      {"--aov brightest", aov::any_needs(request.aovs, aov::AovNeeds::brightest) ? "on" : "off"},
      {"--aov albedo or shading_normal",
       aov::any_needs(request.aovs, aov::AovNeeds::auxiliary) ? "on" : "off"},
      {"--noise", std::to_string(request.noise)},
      {"--clamp", fmt::format("{}", request.clamp)},
      {"samples a pixel", std::to_string(scene.image.samples)},
      {"backend", std::string(executors::backend_name(request.backend))},
      // The processors' executors compute the same wherever the same program runs.
      {"device", gpu ? executor.description() : "none"},
      {"scene", hash_of_files(scene.files), false},
      {"options laid over the scene", ContentHash().add(request.scene.as_written()).hex(), false},
      {"shaders of --shaders", hash_of_files(executor.source_files()), false},
      {"--fast-math", request.executor.fast_math ? "on" : "off"},
      {"--inject-fault", request.executor.fault},
      {"--band-memory", std::to_string(request.long_render.band_mebibytes)},
      {"version of eyeray", EYERAY_VERSION},
      {"build of eyeray", hash_of_files(std::array{fs::path("/proc/self/exe")}), false},
  };
}

}  // namespace eyeray::cli
