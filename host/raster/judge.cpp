#include "host/raster/judge.hpp"

namespace eyeray::engine::raster {
namespace {

bool allows(const Possible& possible, const Seen& seen) {
  if (!seen.anything) return possible.allows_nothing();
  return seen.in_list ? possible.allows(seen.id, seen.nearness) : possible.may_hide_all(seen.nearness);
}

}  // namespace

Judgement judge(const Seen& traced, const Seen& drawn, const Vec2& center,
                std::span<const ScreenTriangle> triangles, const View& view, const Exactness& exactness) {
  bool ray_is_right = false;
  for (const bool tessellated : {false, true}) {
    const Possible possible(Viewer::ray, center, triangles, view, exactness, tessellated);
    ray_is_right = allows(possible, traced);
    if (!ray_is_right) continue;
    const Possible drawable(Viewer::rasteriser, center, triangles, view, exactness, tessellated);
    if (!allows(drawable, drawn)) continue;

    if (traced.anything && !traced.in_list) return {Judgement::hidden};
    if (traced.anything == drawn.anything && traced.id == drawn.id) return {Judgement::equal};
    if (tessellated) return {Judgement::explained, compare::RasterCause::tessellation};
    const bool both =
        traced.anything && drawn.anything && possible.is_within(traced.id) && possible.is_within(drawn.id);
    return {Judgement::explained, both ? compare::RasterCause::depth : compare::RasterCause::edge};
  }
  return {Judgement::unexplained, {}, !ray_is_right};
}

}  // namespace eyeray::engine::raster
