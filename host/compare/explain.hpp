// A pixel may differ from the reference where the reference itself jumps. It is rendered again at points up
// to 0.004 pixels away, and a value within the range of the results is explained.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "host/compare/tolerance.hpp"
#include "host/rounding/places.hpp"
#include "host/rounding/ways.hpp"

namespace eyeray::engine::compare {

// The reference at one pixel, every ray of it moved by a fraction of a pixel.
struct Neighbour {
  struct Sample {
    Vec3 color{0.0};
    Counts counts{0.0};
  };
  std::vector<Sample> samples = {{}};
  // The same number of variants of each sample, one after the other. In them, rays start as far off surfaces,
  // and displaced sideways as far, as float32 may put them, or take the darkest or the brightest value of a
  // texture that near. May be empty.
  std::vector<Sample> rounded;
  uint64_t first_surfaces = 0;  // a fingerprint of the primitives that the samples' camera rays hit
  uint64_t first_colors = 0;    // a fingerprint of the surface's own colour where each hits it
  bool direct = true;           // nothing is seen by reflection or refraction
  FirstHit first_hit;           // of the pixel's centre
  double rounding = 0;          // pixels by which float32 may move the camera ray; 0 if unknown
};

// (x, y): a pixel of the whole picture; called from many threads at once.
using Reference = std::function<Neighbour(int x, int y, const Vec2& shift, rounding::Chance chance)>;

// The reference for single samples whose paths are random.
struct PathReference {
  std::function<Reference(int sample)> around;  // of that sample of each pixel
  // The decisions of the shaders' path, event by event. Empty if they are not known to have that trail.
  std::function<std::vector<uint32_t>(Pixel pixel, int sample, uint32_t trail)> shaders;
  // The decisions of the reference's path, moved by `shift`, in one of `variants` ways in which float32 may
  // round it.
  std::function<std::vector<uint32_t>(Pixel pixel, int sample, const Vec2& shift, int variant)> reference;
  int variants = 1;
  std::function<double(Pixel pixel)> rounding;  // Neighbour's
  std::function<std::string(uint32_t event)> describe;
  // Samples of the same number gather the same photons within this distance of the points that they show; 0:
  // none do.
  double shared = 0;
};

enum class Cause {
  silhouette,         // another primitive is hit first
  texture_edge,       // the surface's own colour jumps; of a first hit, uv
  refraction_branch,  // rays reflected or refracted on the way hit something else
  shadow_edge,        // none of these: it is the light that changes
  rounding,     // a ray that leaves a surface starts as close to another, or to an edge, as it is rounded
  crease,       // of a first hit alone: the same surface, whose normal jumps
  grazing,      // of a first hit alone: the same surface, hit at so small an angle that t races
  undecidable,  // the jump is as near to the camera ray, or to a hit, as float32 rounds those: no float32
                // renderer can decide
  diverged,     // of a sample alone: a random path diverges, as one of the reference's nearby does
};
inline constexpr int cause_count = 9;
const char* name(Cause cause);

// The reference in the neighbourhood of one pixel.
class Neighbourhood {
 public:
  // `angles`, `between`: see rounding::places_around.
  Neighbourhood(const Reference& reference, Pixel pixel, int angles, bool between = false);

  // True if `value` lies within [min, max] of the neighbourhood, each bound widened by the tolerance.
  bool explains(const Vec3& value, const Tolerances& tolerances) const;
  // True if each count lies within the bounds of the neighbourhood's counts.
  bool explains(const Counts& value) const;
  // True if `value` is a hit of a primitive that the neighbourhood hits too, with t, position, normal and uv
  // within the bounds found there.
  bool explains(const FirstHit& value, const Tolerances& tolerances) const;
  // True if `value` lies within a neighbourhood in which rays also start as far off surfaces, and displaced
  // sideways as far, as float32 may put them.
  bool explains_as_rounding(const Vec3& value, const Tolerances& tolerances) const;
  bool explains_as_rounding(const Counts& value) const;
  // The cause in the neighbourhood that explains a value.
  Cause cause(const Vec3& value, const Tolerances& tolerances) const;
  Cause cause(const Counts& value) const;
  Cause cause(const FirstHit& value, const Tolerances& tolerances) const;

 private:
  Cause cause_of_samples() const;
  Cause cause_of_first_hit(const Tolerances& tolerances) const;
  // The pixel itself, as it is and with coincident surfaces, and the ring of a rounding error, turned too.
  std::span<const Neighbour> innermost() const { return std::span(neighbours_).first(innermost_); }

  std::vector<Neighbour> neighbours_;
  size_t innermost_ = 0;
};

}  // namespace eyeray::engine::compare
