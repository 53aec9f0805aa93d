// A pixel may differ from the reference where the reference itself jumps. The reference renders the pixel
// again at points up to 0.004 pixels away, and a value within the range of the results is explained.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "host/compare/tolerance.hpp"
#include "host/rounding/positions.hpp"
#include "host/rounding/ways.hpp"

namespace eyeray::engine::compare {

// The reference's results at one pixel, with every camera ray moved by a fraction of a pixel.
struct Neighbour {
  struct Sample {
    Vec3 color{0.0};
    Counts counts{0.0};
  };
  std::vector<Sample> samples = {{}};
  // Variants of the samples, the same number for each sample, one after the other. Their rays start as far
  // off surfaces, and as far sideways, as float32 may put them. Or they take the darkest or the brightest
  // value of a texture within that distance. May be empty.
  std::vector<Sample> rounded;
  uint64_t first_surfaces = 0;  // a fingerprint of the primitives that the samples' camera rays hit
  uint64_t first_colors = 0;    // a fingerprint of the surfaces' own colours at those hits
  bool direct = true;           // nothing is seen by reflection or refraction
  FirstHit first_hit;           // first hit of the ray through the pixel's centre
  double rounding = 0;          // pixels by which float32 may move the camera ray; 0 if unknown
};

// Renders the reference at (x, y), a pixel of the whole picture. It is called from many threads at once.
using Reference =
    std::function<Neighbour(int x, int y, const Vec2& shift, rounding::Coincidence coincidence)>;

// The reference for single samples whose paths are random.
struct PathReference {
  std::function<Reference(int sample)> around;  // the reference for that sample of each pixel
  // The decisions of the shaders' path, event by event. Empty if no decisions with that trail are known.
  std::function<std::vector<uint32_t>(Pixel pixel, int sample, uint32_t trail)> shaders;
  // The decisions of the reference's path, moved by `shift` and rounded in one of the `variants` ways that
  // float32 may take.
  std::function<std::vector<uint32_t>(Pixel pixel, int sample, const Vec2& shift, int variant)> reference;
  int variants = 1;
  std::function<double(Pixel pixel)> rounding;  // Neighbour::rounding
  std::function<std::string(uint32_t event)> describe;
  // Samples of the same number gather the same photons within this distance of the points that they show. 0:
  // they gather none.
  double shared = 0;
};

enum class Cause {
  silhouette,         // another primitive is hit first
  texture_edge,       // the surface's own colour jumps; for a first hit, its uv
  refraction_branch,  // reflected or refracted rays hit something else
  shadow_edge,        // none of the causes above: the light changes
  rounding,     // a ray that leaves a surface starts within its rounding error of another surface or an edge
  crease,       // for first hits only: the same surface is hit, but its normal jumps
  grazing,      // for first hits only: the same surface is hit at so small an angle that t changes fast
  undecidable,  // the jump lies within float32's rounding of the camera ray or of a hit: no float32 renderer
                // can decide
  diverged,     // for samples only: a random path diverges, as one of the reference's paths nearby does
};
inline constexpr int cause_count = 9;
const char* name(Cause cause);

// The reference in the neighbourhood of one pixel.
class Neighbourhood {
 public:
  // `angles`, `between`: see rounding::positions_around.
  Neighbourhood(const Reference& reference, Pixel pixel, int angles, bool between = false);

  // True if `value` lies within [min, max] of the neighbourhood, each bound widened by the tolerance.
  bool explains(const Vec3& value, const Tolerances& tolerances) const;
  // True if each count lies within the bounds of the neighbourhood's counts.
  bool explains(const Counts& value) const;
  // True if `value` is a hit of a primitive that the neighbourhood hits too, with t, position, normal and uv
  // within the bounds found there.
  bool explains(const FirstHit& value, const Tolerances& tolerances) const;
  // True if `value` lies within the neighbourhood's bounds, with Neighbour::rounded included: rays start as
  // far off surfaces, and as far sideways, as float32 may put them.
  bool explains_as_rounding(const Vec3& value, const Tolerances& tolerances) const;
  bool explains_as_rounding(const Counts& value) const;
  // The cause in the neighbourhood that explains a value.
  Cause cause(const Vec3& value, const Tolerances& tolerances) const;
  Cause cause(const Counts& value) const;
  Cause cause(const FirstHit& value, const Tolerances& tolerances) const;

 private:
  Cause cause_of_samples() const;
  Cause cause_of_first_hit(const Tolerances& tolerances) const;
  // The results at the pixel itself, as it is and with coincident surfaces, and on the ring of a rounding
  // error, with turned rays too.
  std::span<const Neighbour> innermost() const { return std::span(neighbours_).first(innermost_); }

  std::vector<Neighbour> neighbours_;
  size_t innermost_ = 0;
};

}  // namespace eyeray::engine::compare
