#include "host/session/warnings.hpp"

#include <fmt/format.h>

#include "host/render/flags.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::engine::session {

PictureQuality quality_of(const Scene& scene, double noise, double clamp, int64_t pixels,
                          const render::RenderTotals& totals) {
  PictureQuality quality{.flags = totals.flags,
                         .flagged = totals.flagged_pixels,
                         .clamp = clamp,
                         .clamped = totals.clamped,
                         .outliers = totals.outliers,
                         .outlier_share = totals.outlier_share,
                         .most_samples = totals.most_samples};
  if (walks_at_random(scene.render.integrator)) quality.fireflies = totals.fireflies;
  if (noise > 0 && totals.samples_done > 0) {
    quality.noise = noise;
    quality.greatest_noise = totals.greatest_noise;
    quality.quiet_share = double(totals.quiet_pixels) / double(pixels);
  }
  return quality;
}

Diagnostic warning(std::string sentence) {
  return {Severity::warning, {}, std::move(sentence), ""};
}

std::vector<Diagnostic> warnings_of(const PictureQuality& quality) {
  std::vector<Diagnostic> warnings;
  const auto warn = [&](std::string sentence) { warnings.push_back(warning(std::move(sentence))); };
  if (quality.flags) warn(render::flag_warning(quality.flags, quality.flagged));
  if (quality.quiet_share < 1)
    warn(fmt::format(
        "{:.3g} % of the pixels have more noise than {}, up to {:.2g}: {} samples a pixel are too "
        "few; allow more",
        100 * (1 - quality.quiet_share), quality.noise, quality.greatest_noise, quality.most_samples));
  if (quality.clamp > 0)
    warn(fmt::format("the picture is biased: clamp cut {} sample{} to {:g}", quality.clamped,
                     quality.clamped == 1 ? "" : "s", quality.clamp));
  if (quality.outliers.pixels > 0)
    warn(fmt::format("the picture is biased: {} pixel{} lost fireflies, {:.2g} % of all light",
                     quality.outliers.pixels, quality.outliers.pixels == 1 ? "" : "s",
                     100 * quality.outlier_share));
  if (quality.fireflies > 0 && quality.clamp == 0 && quality.outliers.pixels == 0)
    warn(
        fmt::format("{} sample{} more than {:g} times as bright as the mean of the picture, and {} in full; "
                    "the AOV brightest shows where",
                    quality.fireflies, quality.fireflies == 1 ? " is" : "s are",
                    render::Brightness::times_of_fireflies, quality.fireflies == 1 ? "counts" : "count"));
  if (!quality.illegible.empty()) warn(quality.illegible);
  return warnings;
}

}  // namespace eyeray::engine::session
