// Where in a pixel its samples may lie: the rows of shaders/samplers/registry.h. reference/sampler.hpp has
// them in float64.
#pragma once

#include <cstdint>
#include <string_view>

#include "shaders/samplers/registry.h"

namespace eyeray {

enum class SamplePattern : uint32_t {
#define X(name, number) name = number,
  SAMPLERS(X)
#undef X
};

// As `pattern` in [image] names them.
inline constexpr std::string_view sample_patterns[] = {
#define X(name, number) #name,
    SAMPLERS(X)
#undef X
};

}  // namespace eyeray
