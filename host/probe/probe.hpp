// Looks into one sample of one pixel, by several executors (docs/report.md, the probe).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/executors/executor.hpp"
#include "host/probe/overlay.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::probe {

struct Options {
  std::vector<executors::Backend> backends{executors::Backend::gpu, executors::Backend::twin,
                                           executors::Backend::reference};
  executors::ExecutorOptions executor;
  int x = 0, y = 0;
  std::optional<uint32_t> sample;  // none: the first sample whose colours differ, or else the first
};

// One executor that took part.
struct Participant {
  executors::Backend backend;
  std::string description;
  PixelSample sample;
};

struct Findings {
  std::string scene;  // its file
  int width = 0, height = 0;
  int x = 0, y = 0;
  uint32_t sample = 0;  // sample of `samples`
  int samples = 1;
  Vec3 eye{0.0};  // points in the overlay are relative to it
  std::vector<Participant> participants;
  std::vector<std::string> notes;  // further notes, a sentence each
  Overlay overlay{0};
  std::vector<std::string> hits;  // the hit of each ray of the overlay: `sphere "left eye", scene.toml:12`

  // The first difference in the order of a ray's life: a ray that some executors lack, or a line of a ray.
  // Nothing if there is no difference.
  struct Location {
    size_t ray;
    std::optional<size_t> line;
  };
  std::optional<Location> first_difference() const;
  // The rays that lead to a ray, and itself: `camera ray / refracted ray / shadow ray to light 0`.
  std::string way_to(size_t ray) const;
};

// Error (bad_input) if the picture has no such pixel, or the pixel no such sample, and the errors of
// make_executor.
Findings probe_pixel(const Scene& scene, const Options& options);

// The findings as text for people, with a newline after every line; if `colored`, with a terminal's codes.
std::string to_text(const Findings& findings, bool colored);
// The findings as one JSON document, on one line.
std::string to_json(const Findings& findings);

// A ray in words: "reflected ray", "shadow ray to light 2".
std::string describe(const Ray& ray);

}  // namespace eyeray::engine::probe
