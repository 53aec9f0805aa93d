// The integrators that a scene may name: the rows of shaders/integrators/rows.h. What they compute is
// said by reference/integrator.hpp, in float64.
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

// As `integrator` in [render] names them.
inline constexpr std::string_view integrator_names[] = {
#define X(name, ...) #name,
    INTEGRATORS(X)
#undef X
};

// Where a path hits something, shadow rays go to these; to one, chosen among lights and surfaces that emit.
enum class ShadowRays { no_light, each_light, one_light };

struct IntegratorTraits {
  ShadowRays shadow_rays;
  uint32_t ways;  // in which a path goes on where it hits something, at most
};

constexpr IntegratorTraits traits_of(IntegratorType type) {
  constexpr IntegratorTraits traits[] = {
#define X(name, number, lights, ways) {ShadowRays::lights, ways},
      INTEGRATORS(X)
#undef X
  };
  return traits[uint32_t(type)];
}

// Whether its paths draw random numbers on their way. They find what light comes through glass; so shadow
// rays, which else pass through it weakened, end there.
constexpr bool walks_at_random(IntegratorType type) {
  return traits_of(type).shadow_rays == ShadowRays::one_light;
}

// Whether lights send out photons, which its paths gather (scene/photons.hpp).
constexpr bool sends_photons(IntegratorType type) {
  return type == IntegratorType::sppm;
}

}  // namespace eyeray::engine
