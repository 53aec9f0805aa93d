// The positions of samples in a pixel: the rows of shaders/samplers/rows.h. reference/sampler.hpp has
// them in float64.
#pragma once

#include <cstdint>
#include <string_view>

#include "shaders/samplers/rows.h"

namespace eyeray::engine {

enum class SamplePattern : uint32_t {
#define X(name, number, count) name = number,
  SAMPLERS(X)
#undef X
};

// The values of `pattern` in [image].
inline constexpr std::string_view sample_patterns[] = {
#define X(name, ...) #name,
    SAMPLERS(X)
#undef X
};

// The numbers of samples that a pixel may have.
enum class SampleCount { square, any };

constexpr SampleCount sample_count_of(SamplePattern pattern) {
  constexpr SampleCount counts[] = {
#define X(name, number, count) SampleCount::count,
      SAMPLERS(X)
#undef X
  };
  return counts[uint32_t(pattern)];
}

}  // namespace eyeray::engine
