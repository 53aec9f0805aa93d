#include "host/compare/raster_result.hpp"

#include <numeric>

namespace eyeray::engine::compare {

const char* name(RasterCause cause) {
  constexpr const char* names[raster_cause_count] = {"edge", "depth", "tessellation"};
  return names[size_t(cause)];
}

int64_t RasterResult::explained_pixels() const {
  return std::accumulate(explained.begin(), explained.end(), int64_t{0});
}

}  // namespace eyeray::engine::compare
