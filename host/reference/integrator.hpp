// The interface of integrators, in float64. An integrator is one .cpp here, one .glsl in shaders/integrators
// and one row in integrators/rows.h.
#pragma once

#include <string_view>

#include "host/core/pixel.hpp"
#include "host/reference/media.hpp"
#include "host/reference/observer.hpp"
#include "host/reference/tracer.hpp"
#include "host/rounding/displacement.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::engine::reference {

// A sample: its pixel, counted along the rows, and its index in the pixel.
struct SampleId {
  uint32_t pixel;
  uint32_t index;
};

struct Integrator {
  std::string_view manual;  // Markdown
  // Traces the sample of a camera ray, which has a unit direction and starts in `media`. `observer` has been
  // notified of this ray already, and is notified of the rest.
  PixelSample (*sample)(const Tracer& tracer, const SampleId& id, const Ray& ray, const MediaStack& media,
                        const rounding::Displacement& displacement, const Observer& observer);
};

const Integrator& integrator(IntegratorType type);

// The denoiser's auxiliary values of sample `id`, for the integrator `path`.
AuxiliarySample path_auxiliary(const Tracer& tracer, const SampleId& id, const Ray& ray,
                               const MediaStack& media);

}  // namespace eyeray::engine::reference
