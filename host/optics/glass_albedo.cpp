#include "host/optics/glass_albedo.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/vec.hpp"
#include "host/optics/fresnel.hpp"
#include "host/optics/visible_normals.hpp"

namespace eyeray::engine::optics {
namespace {

constexpr int least_turns = 24, least_heights = 72;

}  // namespace

double glass_albedo_integral(double cosine, double roughness, double ior_from, double ior_to, int finer) {
  const double ratio = ior_from / ior_to;
  const VisibleNormals normals(cosine, roughness);
  const Vec3 o = normals.viewer();
  return normals.mean(least_turns * finer, least_heights * finer, [&](const Vec3& h, double along) {
    const double mirrored = dielectric_reflectance(along, ior_from, ior_to);
    const double up = 2 * along * h.z - o.z;
    double sum = up > 0 ? mirrored * normals.leaving(up) : 0;
    if (mirrored == 1) return sum;
    const double beyond = std::sqrt(std::max(0.0, 1 - ratio * ratio * (1 - along * along)));
    const double down = ratio * o.z - (ratio * along - beyond) * h.z;
    if (down > 0) sum += (1 - mirrored) * normals.leaving(down);
    return sum;
  });
}

}  // namespace eyeray::engine::optics
