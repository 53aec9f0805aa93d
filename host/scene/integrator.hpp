// The integrators that a scene may name: the rows of shaders/integrators/registry.h. What they compute is
// said by reference/integrator.hpp, in float64.
#pragma once

#include <cstdint>
#include <string_view>

#include "shaders/integrators/registry.h"

namespace eyeray {

enum class IntegratorType : uint32_t {
#define X(name, number, shadow_rays, scatters) name = number,
  INTEGRATORS(X)
#undef X
};

// As `integrator` in [render] names them.
inline constexpr std::string_view integrator_names[] = {
#define X(name, ...) #name,
    INTEGRATORS(X)
#undef X
};

struct IntegratorTraits {
  bool shadow_rays;  // one to each light
  bool scatters;     // whether paths go on where they hit something
};

constexpr IntegratorTraits traits_of(IntegratorType type) {
  constexpr IntegratorTraits traits[] = {
#define X(name, number, shadow_rays, scatters) {shadow_rays, scatters},
      INTEGRATORS(X)
#undef X
  };
  return traits[uint32_t(type)];
}

}  // namespace eyeray
