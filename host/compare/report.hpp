// The findings of `eyeray verify` on a scene, for people and for programs.
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
};

// Gate A for a pair of executors.
struct ExactResult {
  std::string value, other;  // names
  int64_t ulp = 0;           // the bound
  ExactComparison comparison;
};

// Gates B and C for one executor against the reference.
struct ReferenceResult {
  std::string value;
  Tolerances tolerances;
  ReferenceComparison comparison;
  std::optional<Metrics>
      metrics;  // absent where the pictures could not be compared; max_at in the whole picture
};

// Gate G: a golden picture against the first executor's.
struct GoldenResult {
  std::string file;
  std::string value;         // the executor
  std::string incomparable;  // why nothing was compared; empty when everything was
  image::Image picture;      // as it was before an update, or the part of it that was compared
  Tally colors;              // the golden picture's, as if the executor's were the reference
  std::optional<Metrics> metrics;
  std::vector<std::string> changed;  // changed inputs of the golden picture: "scene hash", "executor"
  bool updated = false;              // whether the executor's picture has replaced it since
  std::string refused;               // why it has not, though asked for

  bool passes() const { return updated || (incomparable.empty() && colors.passes()); }
};

// Gate D for photons: those that go another way than the reference's, or the same way to other points, which
// all executors then leave out. The reference must explain each by its own rounding.
struct PhotonTally {
  int64_t sent = 0;
  int64_t diverged = 0;
  int64_t displaced = 0;
  int64_t unexplained = 0;  // of both
  std::string worst;        // the first of these, and its effect
  int depth = 0;            // the scene's max_depth

  // All of them are explained, and no picture shows them. Pictures must show most of the photons: 4 % may
  // diverge, more where photons may go far. Half of all are aimed at glass and mirrors, where they diverge.
  int64_t may_diverge() const;
  // Curved surfaces and grazing angles multiply rounding, and displace photons by that much: a tenth of them
  // may be displaced.
  int64_t may_be_displaced() const { return std::max<int64_t>(4, sent / 10); }
  bool passes() const {
    return unexplained == 0 && diverged <= may_diverge() && displaced <= may_be_displaced();
  }
};

struct Report {
  // Why there was nothing to compare, where a scene of several could not be rendered; else empty.
  std::string not_verified;
  bool may_stay_unverified = false;  // whether that is no failure
  double seconds = 0;                // that it took to render and compare everything
  std::string options;  // of the command line that change the picture, each with a space before it
  std::string scene;
  std::vector<std::string> changed_shaders;  // files that take the place of eyeray's own and differ from them
  bool twin_has_changed_shaders = false;     // as the gpu does
  int width = 0, height = 0;                 // of the whole picture
  Rect area;                                 // the compared area
  int samples = 1;
  std::vector<Participant> participants;
  std::vector<ExactResult> exact;
  std::vector<ReferenceResult> against_reference;
  std::vector<RasterResult> raster;    // gate R, of every participant; empty where it was not asked for
  std::optional<PhotonTally> photons;  // set if the scene's integrator emits any
  std::optional<GoldenResult> golden;
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
  // True if all gates pass except gate G, which compares with an earlier picture of the scene.
  bool own_gates_pass() const;
  // "passed", "failed", or "skipped", if it may stay unverified and did.
  std::string_view verdict() const;
  // A sentence on where to look for the fault: the first value that differs, and on whose side. Empty
  // if nothing indicates it.
  std::string diagnosis() const;
  // The largest of all gates' counts.
  int64_t count(int64_t (*of)(const Tally&)) const;
  // Twice the share of pixels that are explained and count against the cap, of the gate that has most,
  // rounded up to 1e-5: the allowance that the scene needs. Nothing where more than the cap fails.
  std::optional<double> healthy_allowance() const;
  // The pixel to examine: the worst of the first gate that fails. Empty if all gates pass.
  std::optional<Pixel> pixel_to_look_at() const;
  // The first hits that the report shows.
  std::vector<FirstHit> shown_hits() const;
  // "eyeray verify SCENE --crop X,Y,9,9", nine pixels around that one.
  std::string command_to_look() const;
  // "eyeray probe SCENE X,Y", that pixel's rays; both "" when all gates pass.
  std::string command_to_probe() const;
};

// Verdict first, then counts, worst pixels and the command that shows them; lines, each ended.
std::string to_text(const Report& report);
// "passed scenes/b.toml …", a line of a table whose names are `width` characters wide.
std::string to_row(const Report& report, size_t width);
// "3 scenes in 4.2 s: 2 passed, 1 failed (scenes/b.toml)", for several.
std::string summary(std::span<const Report> reports);
// All of it as one JSON document on one line; NaN and infinities are null.
std::string to_json(std::span<const Report> reports);

// JUnit's XML, a test case a scene: the first failure as its message, the whole report as its text.
std::string to_junit(std::span<const Report> reports);
// For GitHub Actions: each failure as an annotation ("::error file=…"), and a table in Markdown.
std::string to_annotations(std::span<const Report> reports);
std::string to_markdown(std::span<const Report> reports);

// "RMSE 1e-05, PSNR 100.0 dB, …", on one line without its end.
std::string to_text(const Metrics& metrics);
// All of them, lines that start with `indent`, each ended.
std::string to_lines(const Metrics& metrics, const std::string& indent);
nlohmann::ordered_json metrics_json(const Metrics& metrics);

}  // namespace eyeray::engine::compare
