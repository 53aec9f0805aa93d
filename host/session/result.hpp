// The result of a request.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/core/ray_counts.hpp"
#include "host/core/stopwatch.hpp"
#include "host/render/render.hpp"
#include "host/session/warnings.hpp"

namespace eyeray::engine::session {

struct Result {
  render::RenderTotals totals;  // `interrupted` also if the first hits were interrupted
  Rect crop;                    // the rendered area
  int samples = 0;              // requested for each pixel
  int64_t pixels = 0;           // the number in the crop, or in the share
  std::optional<render::Shard> shard;
  std::string device;           // Executor::description()
  double longest_dispatch = 0;  // ExecutorFacts::longest_dispatch
  uint64_t flagged_hits = 0;    // pixels; 0 if no channel is made of first hits
  PictureQuality quality;       // quality of colour and first hits
  std::vector<Diagnostic> warnings;
  std::vector<std::filesystem::path> files;  // written
  std::filesystem::path checkpoint;          // the file left to resume from; empty: none
  std::optional<double> metered;             // the exposure in stops, if it was measured
  std::optional<double> noise_left;          // DenoisedPicture::error, if it was denoised
  std::optional<RayCounts> ray_kinds;        // ray kinds of this run, if requested
  StageTimes times;
  double seconds = 0;  // seconds of the whole request

  bool interrupted() const { return totals.interrupted; }
  // The share of all samples that were taken.
  double share() const;
  // The average number of samples of a pixel.
  double mean_samples() const { return pixels > 0 ? double(totals.samples_taken) / double(pixels) : 0; }
  // The rate of this run, without resumed rays.
  double rays_per_second() const;
};

}  // namespace eyeray::engine::session
