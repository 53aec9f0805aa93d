// The reference: a float64 renderer written from the mathematics, which the shaders are checked against. It
// shares the scene with them, and nothing else.
#pragma once

#include "host/core/pixel.hpp"
#include "host/reference/camera.hpp"
#include "host/reference/integrator.hpp"
#include "host/reference/tracer.hpp"

namespace eyeray::engine::reference {

class Renderer {
 public:
  // `scene` must outlive the renderer. The pixels do not depend on `acceleration`.
  explicit Renderer(const Scene& scene, Acceleration acceleration = Acceleration::bvh);

  // Sample `index` of pixel (x, y), by the scene's integrator. The ray is displaced by `shift` pixels. With a
  // displacement.pivot, the ray turns about its point at that distance, and is displaced to the other side
  // beyond it.
  PixelSample sample(int x, int y, uint32_t index, Vec2 shift = {0, 0},
                     const rounding::Displacement& displacement = {}, const Observer& observer = {}) const;
  // The denoiser's auxiliary values of that sample; for `path` alone.
  AuxiliarySample auxiliary(int x, int y, uint32_t index) const;
  // The first hit of the ray through the pixel's centre, and the lens' centre if there is a lens, displaced
  // by `shift` pixels. Only pivot and `coincident` of `displacement` count.
  FirstHit first_hit(int x, int y, Vec2 shift = {0, 0},
                     const rounding::Displacement& displacement = {}) const;
  // The first hit of the camera ray of sample `index`.
  FirstHit first_hit_of_sample(int x, int y, uint32_t index, Vec2 shift,
                               const rounding::Displacement& displacement) const;
  // The number of pixels by which float32 may displace the ray through the pixel's centre at `t`.
  double rounding(int x, int y, double t) const;
  // A rounding::Displacement::pivot a little behind the hit of the ray through the pixel's centre; 0 if that
  // ray hits nothing. There are eight pivots, of which `which` modulo 8 selects one.
  double pivot(int x, int y, uint32_t which) const;

  const Tracer& tracer() const { return tracer_; }

 private:
  // The position of a camera ray in the picture, and its position on the lens.
  struct Aim {
    Vec2 position;
    Vec2 lens{0.0};
  };
  Aim aim(int x, int y, uint32_t index) const;
  SampleId id(int x, int y, uint32_t index) const;
  Ray camera_ray(const Aim& aim, const Vec2& shift, double pivot) const;
  FirstHit hit(const Aim& aim, const SampleId& id, const Vec2& shift,
               const rounding::Displacement& displacement) const;

  const Scene& scene_;
  Tracer tracer_;
  CameraRays camera_;
  MediaStack media_;  // around the eye
  uint32_t flags_ = 0;
};

}  // namespace eyeray::engine::reference
