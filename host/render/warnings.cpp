#include "host/render/warnings.hpp"

#include <fmt/format.h>

#include "host/render/flags.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::render {

PictureQuality quality_of(const Scene& scene, const RenderOptions& options, const RenderTotals& totals) {
  PictureQuality quality{.flags = totals.flags,
                         .flagged = totals.flagged_pixels,
                         .clamp = options.clamp,
                         .clamped = totals.clamped,
                         .most_samples = totals.most_samples};
  if (walks_at_random(scene.render.integrator)) quality.fireflies = totals.fireflies.samples;
  if (options.noise > 0 && totals.samples_done > 0) {
    const int64_t pixels = options.crop.pixels() ? options.crop.pixels()
                                                 : Rect{0, 0, scene.image.width, scene.image.height}.pixels();
    quality.noise = options.noise;
    quality.greatest_noise = totals.greatest_noise;
    quality.quiet_share = double(totals.quiet_pixels) / double(pixels);
  }
  return quality;
}

std::vector<std::string> warnings_of(const PictureQuality& quality) {
  std::vector<std::string> warnings;
  if (quality.flags) warnings.push_back(flag_warning(quality.flags, quality.flagged));
  if (quality.quiet_share < 1)
    warnings.push_back(fmt::format(
        "{:.3g} % of the pixels have more noise than {}, up to {:.2g}: {} samples a pixel are too "
        "few; allow more",
        100 * (1 - quality.quiet_share), quality.noise, quality.greatest_noise, quality.most_samples));
  if (quality.clamp > 0)
    warnings.push_back(fmt::format("the picture is biased: clamp cut {} sample{} to {:g}", quality.clamped,
                                   quality.clamped == 1 ? "" : "s", quality.clamp));
  else if (quality.fireflies > 0)
    warnings.push_back(
        fmt::format("{} sample{} more than {:g} times as bright as the mean of the picture, and {} in full; "
                    "the AOV brightest shows where",
                    quality.fireflies, quality.fireflies == 1 ? " is" : "s are", Fireflies::times,
                    quality.fireflies == 1 ? "counts" : "count"));
  if (!quality.illegible.empty()) warnings.push_back(quality.illegible);
  return warnings;
}

}  // namespace eyeray::render
