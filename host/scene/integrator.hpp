// The integrators that a scene may name: the rows of shaders/integrators/rows.h. Their definitions are in
// reference/integrator.hpp, in float64.
#pragma once

#include <cstdint>
#include <string_view>

#include "shaders/integrators/rows.h"

namespace eyeray::engine {

enum class IntegratorType : uint32_t {
#define X(name, number, lights, ways) name = number,
  INTEGRATORS(X)
#undef X
};

// The values of `integrator` in [render].
inline constexpr std::string_view integrator_names[] = {
#define X(name, ...) #name,
    INTEGRATORS(X)
#undef X
};

// The targets of shadow rays at a hit of a path. one_light: chosen among lights and emitting surfaces.
enum class ShadowRays { no_light, each_light, one_light };

struct IntegratorTraits {
  ShadowRays shadow_rays;
  uint32_t ways;  // the most rays by which a path goes on from a hit
};

constexpr IntegratorTraits traits_of(IntegratorType type) {
  constexpr IntegratorTraits traits[] = {
#define X(name, number, lights, ways) {ShadowRays::lights, ways},
      INTEGRATORS(X)
#undef X
  };
  return traits[uint32_t(type)];
}

// True if the integrator's paths draw random numbers on their way. Such paths find the light that comes
// through glass. So their shadow rays end at glass, while those of other integrators pass through it
// weakened.
constexpr bool walks_at_random(IntegratorType type) {
  return traits_of(type).shadow_rays == ShadowRays::one_light;
}

// True if lights emit photons, which the integrator's paths gather (scene/photons.hpp).
constexpr bool sends_photons(IntegratorType type) {
  return type == IntegratorType::sppm;
}

}  // namespace eyeray::engine
