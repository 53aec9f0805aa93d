// The rays of one sample, for integrators whose paths continue at surfaces: their hits, how they leave
// surfaces, and their number.
#pragma once

#include <optional>

#include "host/reference/crossings.hpp"
#include "host/reference/integrator.hpp"
#include "host/reference/trail.hpp"

namespace eyeray::engine::reference {

// The point where a ray hits a surface, seen from the viewer's side.
struct Interaction {
  SurfacePoint surface;     // with both normals on the side from which the ray came
  Vec3 d;                   // the ray's direction, unit
  double cos_view = 0;      // cosine of the angle between the shading normal and −d, in [0, 1]
  uint64_t primitive;       // ~0 for a point of a medium
  bool has_medium = false;  // the surface's material fills its object with a medium
  Vec3 dimming{1};          // the medium's transmittance on the way here
  double ior_before = 1, ior_beyond = 1;
  MediaStack media_beyond = {};  // the media in which a refracted ray is
  Scattering scattering = {};
  Bsdf bsdf = {};

  bool in_medium() const { return primitive == ~uint64_t{0}; }
  Vec3 mirrored() const { return glm::normalize(d + 2 * cos_view * surface.normal); }
  // The direction of the refracted ray. There must be no total reflection.
  Vec3 refracted() const;
};

constexpr int most_panes = 8;       // panes that a shadow ray to a light with an extent can pass
constexpr int most_passed = 65536;  // surfaces that any shadow ray can pass

// The share of light that comes through this length of a medium.
Vec3 transmittance(const Medium& medium, double length);

class SampleRays {
 public:
  SampleRays(const Tracer& tracer, const rounding::Displacement& displacement, const Observer& observer)
      : tracer_(tracer), scene_(tracer.scene()), displacement_(displacement), observer_(observer) {}

  // The first hit of the ray; empty if it hits nothing.
  std::optional<Hit> trace(const Ray& ray);
  // The interaction at that hit. `media`: those that the ray is in. `throughput`: the share of its light that
  // arrives in the pixel. `dimming`: the share of light that the medium leaves on the way.
  Interaction interaction(const Ray& ray, const Hit& hit, const MediaStack& media, const Vec3& throughput,
                          const Vec3& dimming);
  // The innermost of `media`; the scene's own medium if `media` is empty.
  Medium medium(const MediaStack& media) const;
  // The length of a homogeneous medium that has the transmittance of the ray up to t, and the t at which that
  // length is `length`.
  double medium_length(const MediaStack& media, const Ray& ray, double t) const;
  double medium_distance(const MediaStack& media, const Ray& ray, double length) const;
  // The light seen by a ray in that unit direction if it hits nothing.
  Vec3 surroundings(const Vec3& d) const;
  // The unit direction as float32 may round it.
  Vec3 rounded(const Vec3& d) const;
  // A ray that leaves a light, as float32 may round it.
  Ray start_ray(const Ray& ray);
  // A ray that leaves the surface, as float32 may round it.
  Ray spawn_ray(const SurfacePoint& point, const Vec3& d, Leaving leaving = Leaving::straight);
  // A ray that leaves the surface towards a light at that distance from the point. Direction and distance
  // change if the ray starts elsewhere.
  Ray spawn_to_light(const SurfacePoint& point, const Vec3& l, Leaving leaving, double& distance);
  // The end of a shadow ray in direction l to a point of an area light: as far off the light as rays start
  // off surfaces.
  Vec3 end_before(const Vec3& point, const Vec3& normal, const Vec3& l) const;
  // True if a light in direction l at that distance is in front of the surface. For a light in its plane
  // float32 may decide either way.
  bool faces(const SurfacePoint& point, const Vec3& l, double distance) const;
  // True if the light is on the viewer's side of the surface.
  bool is_before(const SurfacePoint& point, const Vec3& l, double distance) const;
  // The transmittance of a shadow ray up to `t_end`.
  double shadow(const Ray& ray, double t_end);
  // The transmittance of a shadow ray if only panes and interfaces let light through. `media`: the media in
  // which the ray starts.
  Vec3 through_panes(Ray ray, double t_end, bool has_extent, MediaStack media);

  // Records a decision of the path, in order.
  void decided(Event kind, uint64_t value);

  PixelSample sample(const Vec3& color) const;

  uint32_t reflected = 0;
  uint32_t refracted = 0;
  uint32_t total_reflections = 0;
  bool cut_off = false;   // true if max_depth ended the path
  double background = 0;  // PixelSample::background

 private:
  Bsdf bsdf(const Material& material, const ScatteringContext& context, const Scattering& scattering) const;
  Scattering scattering(const Ray& ray, const Hit& hit, const SurfacePoint& point,
                        ScatteringContext context) const;
  bool takes_farther() const;
  double cosine_rounding(const SurfacePoint& point, double distance) const;
  double tilt(const SurfacePoint& point, double distance) const;

  const Tracer& tracer_;
  const Scene& scene_;
  rounding::Displacement displacement_;
  const Observer& observer_;
  uint32_t spawned_ = 0;
  uint32_t rays_ = 0;
  uint32_t hits_ = 0;
  uint32_t flags_ = 0;
  uint32_t trail_ = 1;
};

}  // namespace eyeray::engine::reference
