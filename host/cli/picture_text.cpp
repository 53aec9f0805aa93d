#include "host/cli/picture_text.hpp"

#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "host/core/github_text.hpp"
#include "host/core/peak_memory.hpp"
#include "host/core/readable.hpp"
#include "host/core/standard_streams.hpp"
#include "host/render/flags.hpp"

namespace eyeray::engine::cli {
namespace {

using program::Json;
using session::Result;

// "640×480", or "3/64 of 640×480, 4800 pixels".
std::string size_of(const Result& picture) {
  const std::string whole = fmt::format("{}×{}", picture.crop.width, picture.crop.height);
  if (!picture.shard) return whole;
  return fmt::format("{}/{} of {}, {} pixels", picture.shard->index + 1, picture.shard->count, whole,
                     picture.pixels);
}

std::string samples_of(const Result& picture) {
  if (picture.shard && picture.pixels == 0) return "nothing to do";
  const int least = picture.totals.samples_done, most = picture.totals.most_samples;
  std::string text = least == most ? fmt::format("{} sample{} a pixel", least, least == 1 ? "" : "s")
                                   : fmt::format("{} to {} samples a pixel (mean {:.0f})", least, most,
                                                 picture.mean_samples());
  if (picture.noise_left)
    text += fmt::format(", denoised with a mean error of {:.2g} %", 100 * *picture.noise_left);
  if (picture.metered) text += fmt::format(", exposure {:.2f}", *picture.metered);
  return text;
}

Json counts_of(const RayCounts& kinds) {
  return {{"eye", kinds.eye},
          {"eye_hits", kinds.eye_hits},
          {"reflected", kinds.reflected},
          {"refracted", kinds.refracted},
          {"total_reflections", kinds.total_reflections},
          {"cut_off", kinds.cut_off},
          {"shadow", kinds.shadow}};
}

}  // namespace

std::string summary(const Result& picture, size_t parts) {
  const render::RenderTotals& totals = picture.totals;
  std::vector<std::string> names;
  for (const auto& file : picture.files) names.push_back(log_line(file.string()));
  if (parts > 0)
    return fmt::format("{}: {}, {}, {} rays, of {} part{} in {}", fmt::join(names, ", "), size_of(picture),
                       samples_of(picture), totals.rays, parts, parts == 1 ? "" : "s",
                       format_seconds(picture.seconds));
  return fmt::format(
      "{}: {}, {}, {}{} rays in {} ({}), {} in all, on {}", fmt::join(names, ", "), size_of(picture),
      samples_of(picture),
      totals.samples_resumed ? fmt::format("resumed with {} rays, then ", totals.rays_resumed) : "",
      totals.rays - totals.rays_resumed, format_seconds(totals.seconds),
      format_rate(picture.rays_per_second()), format_seconds(picture.seconds), picture.device);
}

Json json_of(const Result& picture, size_t parts) {
  const render::RenderTotals& totals = picture.totals;
  const session::PictureQuality& quality = picture.quality;
  Json json{{"files", Json::array()},
            {"device", picture.device},
            {"width", picture.crop.width},
            {"height", picture.crop.height},
            {"samples", picture.samples},
            {"samples_done", totals.samples_done},
            {"rays", totals.rays},
            {"seconds", picture.seconds},
            {"sampling_seconds", totals.seconds},
            {"sampling_processor_seconds", totals.processor_seconds},
            {"rays_per_second", picture.rays_per_second()},
            {"stages", program::to_json(picture.times)},
            {"longest_dispatch", picture.longest_dispatch},
            {"peak_memory", peak_memory()},
            {"flagged_pixels", totals.flagged_pixels},
            {"flagged_hits", picture.flagged_hits},
            {"flags", Json::array()},
            {"interrupted", picture.interrupted()},
            {"bands", totals.bands}};
  if (parts > 0) json["parts"] = parts;
  if (const auto& shard = picture.shard)
    json["shard"] = {{"index", shard->index + 1}, {"count", shard->count}, {"pixels", picture.pixels}};
  if (quality.noise > 0)
    json["noise"] = {{"wanted", quality.noise},
                     {"greatest", quality.greatest_noise},
                     {"share", quality.quiet_share},
                     {"most_samples", totals.most_samples},
                     {"mean_samples", picture.mean_samples()}};
  if (quality.fireflies > 0) json["fireflies"] = quality.fireflies;
  if (quality.outliers.pixels > 0)
    json["outliers"] = {{"pixels", quality.outliers.pixels}, {"share_of_light", quality.outlier_share}};
  if (quality.clamp > 0) json["clamp"] = {{"at", quality.clamp}, {"samples", quality.clamped}};
  if (picture.metered) json["exposure"] = *picture.metered;
  if (picture.noise_left) json["noise_left"] = *picture.noise_left;
  if (picture.ray_kinds) json["ray_kinds"] = counts_of(*picture.ray_kinds);
  if (totals.samples_resumed > 0)
    json["resumed"] = {{"samples", totals.samples_resumed}, {"rays", totals.rays_resumed}};
  if (!picture.checkpoint.empty()) json["checkpoint"] = picture.checkpoint.string();
  for (const auto& file : picture.files) json["files"].push_back(file.string());
  for (const render::FlagText& each : render::flag_texts())
    if (quality.flags & each.flag) json["flags"].push_back(each.name);
  return json;
}

void print_warnings(const Result& picture) {
  for (const Diagnostic& each : picture.warnings) print_lines(stderr, "eyeray: warning: {}\n", each.message);
}

}  // namespace eyeray::engine::cli
