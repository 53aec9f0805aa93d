// The findings of `eyeray verify` on a scene, or on a kernel that a user brings, for people and for programs.
#pragma once

#include <algorithm>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/compare/against_reference.hpp"
#include "host/compare/buffer_result.hpp"
#include "host/compare/denoised_result.hpp"
#include "host/compare/exact.hpp"
#include "host/compare/metrics.hpp"
#include "host/compare/raster_result.hpp"
#include "host/compare/soundness.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine::compare {

// One executor that took part.
struct Participant {
  std::string name;         // "gpu"
  std::string description;  // "gpu: llvmpipe (LLVM 15.0.6, 256 bits)"
  double seconds = 0;
  uint64_t rays = 0;
  Soundness soundness;
  // Gate S: the faults that the emulator found in the kernels, a sentence each. Other executors have none.
  std::optional<std::vector<std::string>> findings{};
};

// Gate A for a pair of executors.
struct ExactResult {
  std::string value, other;  // names
  int64_t ulp = 0;           // the allowed distance
  ExactComparison comparison;
};

// The results of one executor against the reference: gates B and C, or C and D.
struct ReferenceResult {
  std::string value;
  Tolerances tolerances;
  ReferenceComparison comparison;
  std::optional<Metrics>
      metrics;  // absent if the pictures could not be compared; its max_at is a pixel of the whole picture
};

// Gate G: a golden picture against the first executor's.
struct GoldenResult {
  std::string file;
  std::string value;         // the executor
  std::string incomparable;  // why nothing was compared; empty when everything was
  image::Image picture;      // the golden picture before an update, or the compared part of it
  Tally colors;              // colors of the golden picture, with the executor's as the reference
  std::optional<Metrics> metrics;
  std::vector<std::string> changed;  // changed inputs of the golden picture: "scene hash", "executor"
  bool updated = false;              // whether the executor's picture has replaced it
  std::string refused;               // why a requested update was not made

  bool passes() const { return updated || (incomparable.empty() && colors.passes()); }
};

// Gate D for photons. All executors leave out the photons that go another way than the reference's, or the
// same way to other points. The reference must explain each of these by its own rounding.
struct PhotonTally {
  int64_t sent = 0;
  int64_t diverged = 0;
  int64_t displaced = 0;
  int64_t unexplained = 0;  // the unexplained among the diverged and the displaced
  std::string worst;        // the first unexplained photon, and its effect
  int depth = 0;            // the scene's max_depth

  // The number of photons that may diverge: explained ones, which no picture shows. Pictures must show most
  // of the photons, so 4 % may diverge, and more if max_depth exceeds 8. Half of all photons are aimed at
  // glass and mirrors, where they diverge.
  int64_t may_diverge() const;
  // The number of photons that may be displaced: a tenth. Curved surfaces and grazing angles multiply
  // rounding errors, which displace photons.
  int64_t may_be_displaced() const { return std::max<int64_t>(4, sent / 10); }
  bool passes() const {
    return unexplained == 0 && diverged <= may_diverge() && displaced <= may_be_displaced();
  }
};

struct Report {
  // Why this scene, one of several, could not be rendered, so that nothing was compared; else empty.
  std::string not_verified;
  bool may_stay_unverified = false;  // whether an unverified scene is no failure
  double seconds = 0;                // for rendering and comparing everything
  std::string options;  // the command line's options that change the picture, each with a space before it
  std::string scene;
  std::vector<std::string> changed_shaders;  // files that take the place of eyeray's own and differ from them
  bool twin_has_changed_shaders = false;     // whether the twin has them, as the gpu does
  int width = 0, height = 0;                 // width of the whole picture
  Rect area;                                 // the compared area
  int samples = 1;
  std::vector<Participant> participants;
  std::vector<ExactResult> exact;
  std::vector<ReferenceResult> against_reference;
  std::vector<DenoisedResult> denoised;  // for each executor of the shaders; empty if not requested
  std::vector<RasterResult> raster;      // gate R for every participant; empty if not requested
  std::optional<PhotonTally> photons;    // set if the scene's integrator emits any
  std::optional<GoldenResult> golden;
  std::string dispatch;  // "blur.comp, 8×8×1 work groups of 8×8×1 invocations"; empty if a scene was verified
  std::vector<BufferResult> buffers;  // a kernel's buffers
  // The names of the indices in first hits, such as `sphere "left eye", scene.toml:12`, for the indices that
  // a report names.
  std::map<int32_t, std::string> primitives, materials;
  std::string kept;  // the folder where the evidence lies; empty when nothing was kept

  // "shaders that differ from eyeray's own: my-shaders/math.glsl; the twin has the built-in ones"; "" if
  // there are none.
  std::string note_of_shaders() const;
  // Everything that fails, a sentence each, the deepest cause first; empty when the scene passes. Shaders
  // that differ from eyeray's own come before all that fails.
  std::vector<std::string> failures() const;
  bool passes() const { return failures().empty(); }
  bool is_kernel() const { return !dispatch.empty(); }
  // True if all gates pass except gate G, which compares with an earlier picture of the scene.
  bool own_gates_pass() const;
  // "passed", "failed", or "skipped", if it may stay unverified and did.
  std::string_view verdict() const;
  // A sentence on where to look for the fault: the first value that differs, and on whose side. Empty
  // if nothing indicates it.
  std::string diagnosis() const;
  // The largest value of `of` among the tallies of all gates.
  int64_t count(int64_t (*of)(const Tally&)) const;
  // The allowance that the scene needs: twice the share of explained pixels that count against the cap, in
  // the gate with the largest share, rounded up to 1e-5. Nothing if anything but the cap fails.
  std::optional<double> healthy_allowance() const;
  // The pixel to examine: the worst of the first gate that fails. Empty if all gates pass.
  std::optional<Pixel> pixel_to_look_at() const;
  // The first hits that the report shows.
  std::vector<FirstHit> shown_hits() const;
  // "eyeray verify SCENE --crop X,Y,9,9": the 9 × 9 pixels around pixel_to_look_at(). "" if all gates pass.
  std::string command_to_look() const;
  // "eyeray probe SCENE X,Y": the rays of pixel_to_look_at(). "" if all gates pass.
  std::string command_to_probe() const;
};

// The report as lines, each ended: the verdict, then counts, worst pixels and the command that shows them.
std::string to_text(const Report& report);
// "passed scenes/b.toml …", a line of a table whose names are `width` characters wide.
std::string to_row(const Report& report, size_t width);
// The summary of several reports: "3 scenes in 4.2 s: 2 passed, 1 failed (scenes/b.toml)".
std::string summary(std::span<const Report> reports);
// The reports as one JSON document on one line; NaN and infinities are null.
std::string to_json(std::span<const Report> reports);

// JUnit's XML with a test case for each scene, whose message is the first failure and whose text is the whole
// report.
std::string to_junit(std::span<const Report> reports);
// For GitHub Actions: each failure as an annotation ("::error file=…"), and a table in Markdown.
std::string to_annotations(std::span<const Report> reports);
std::string to_markdown(std::span<const Report> reports);

// "RMSE 1e-05, PSNR 100.0 dB, …", on one line without its end.
std::string to_text(const Metrics& metrics);
// All metrics as lines that start with `indent`, each ended.
std::string to_lines(const Metrics& metrics, const std::string& indent);
nlohmann::ordered_json metrics_json(const Metrics& metrics);

}  // namespace eyeray::engine::compare
