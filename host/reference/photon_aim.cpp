// Jensen: Global Illumination Using Photon Maps, 1996. Veach, Guibas: Optimally Combining Sampling Techniques
// for Monte Carlo Rendering, SIGGRAPH 1995: the one-sample model.
#include "host/reference/photon_aim.hpp"

#include <cmath>

namespace eyeray::engine::reference {
namespace {

constexpr double aimed_share = 0.5;

}  // namespace

std::vector<Window> windows_from(const PhotonSettings& settings, const Vec3& p, const Vec3& n) {
  std::vector<Window> windows;
  for (const PhotonTarget& target : settings.targets) {
    const Vec3 way = target.center - p;
    const double distance = glm::length(way);
    if (distance <= target.radius || glm::dot(way, n) <= -target.radius) continue;
    const double chord = 2 * std::sin(std::asin(target.radius / distance) / 2);
    windows.push_back({way / distance, M_PI * chord * chord});
  }
  return windows;
}

std::vector<Window> windows_along(const PhotonSettings& settings, const Vec3& d) {
  std::vector<Window> windows;
  for (const PhotonTarget& target : settings.targets) {
    const Vec3 way = target.center - settings.center;
    windows.push_back({way - d * glm::dot(way, d), M_PI * target.radius * target.radius});
  }
  return windows;
}

double Aimed::weight(double own) const {
  if (event == 0) return 1;
  return own > 0 ? 1 / (1 - aimed_share + aimed_share * density / own) : 0;
}

Aimed aimed(std::span<const Window> windows, double random, const Vec3& at_random,
            const std::function<Vec3(const Window&)>& in) {
  Aimed it{at_random, !windows.empty() && random < aimed_share};
  if (windows.empty()) return it;
  std::vector<double> ends;
  for (const Window& window : windows) ends.push_back((ends.empty() ? 0 : ends.back()) + window.area);
  const double all = ends.back();
  size_t chosen = windows.size();
  if (it.by_aim) {
    chosen = 0;
    while (chosen + 1 < windows.size() && ends[chosen] <= random / aimed_share * all) ++chosen;
    it.at = in(windows[chosen]);
  }
  uint64_t around = 0;
  for (size_t i = 0; i < windows.size(); ++i) {
    const double distance = glm::length(it.at - windows[i].middle);
    if (i == chosen || M_PI * distance * distance < windows[i].area) ++around;
  }
  it.density = double(around) / all;
  it.event = 32 * windows.size() + around;
  return it;
}

}  // namespace eyeray::engine::reference
