#include "host/core/readable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace eyeray::engine {

std::string format_rate(double rays_per_second) {
  if (!(rays_per_second >= 0)) return "– rays/s";
  if (rays_per_second >= 1e9) return fmt::format("{:.3g} Grays/s", rays_per_second * 1e-9);
  if (rays_per_second >= 1e6) return fmt::format("{:.3g} Mrays/s", rays_per_second * 1e-6);
  return fmt::format("{:.3g} krays/s", rays_per_second * 1e-3);
}

std::string format_seconds(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.0f} µs", seconds * 1e6);
  if (seconds < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (seconds < 60) return fmt::format("{:.3g} s", seconds);
  const auto whole = int64_t(std::min(seconds, 1e15) + 0.5);
  if (seconds < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace eyeray::engine
