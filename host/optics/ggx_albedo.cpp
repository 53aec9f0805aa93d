#include "host/optics/ggx_albedo.hpp"

#include <cmath>

#include "host/core/vec.hpp"
#include "host/optics/mean_by_cosine.hpp"
#include "host/optics/visible_normals.hpp"

namespace eyeray::engine::optics {
namespace {

constexpr int turns = 16, heights = 96;

}  // namespace

GgxAlbedo ggx_albedo_integral(double cosine, double roughness) {
  const VisibleNormals normals(cosine, roughness);
  const Vec3 o = normals.viewer();
  const Vec2 mean = normals.mean(turns, heights, [&](const Vec3& h, double along) {
    const double down = 2 * along * h.z - o.z;
    return down > 0 ? normals.leaving(down) * Vec2(1, std::pow(1 - along, 5)) : Vec2(0);
  });
  return {mean.x, mean.y, 0, 0};
}

std::vector<GgxAlbedo> ggx_albedo_row(int count, double roughness) {
  std::vector<GgxAlbedo> row;
  const double step = 1.0 / (count - 1);
  for (int i = 0; i < count; ++i) row.push_back(ggx_albedo_integral((i * step) * (i * step), roughness));
  const double once = mean_by_cosine(count, [&](int i) { return row[size_t(i)].once; });
  const double edge = mean_by_cosine(count, [&](int i) { return row[size_t(i)].edge; });
  for (GgxAlbedo& albedo : row) {
    albedo.mean_once = once;
    albedo.mean_edge = edge;
  }
  return row;
}

}  // namespace eyeray::engine::optics
