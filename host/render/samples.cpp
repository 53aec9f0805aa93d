#include "render/samples.hpp"

namespace eyeray {

FirstHit to_first_hit(const shader::HitResult& result, const Vec3& eye) {
  FirstHit hit;
  if (result.ids.x == NONE) return hit;
  hit.t = double(result.position_t.w);
  hit.position = eye + Vec3(result.position_t);
  hit.normal = Vec3(result.normal);
  hit.uv = {double(result.uv.x), double(result.uv.y)};
  hit.primitive = int32_t(result.ids.x);
  hit.material = int32_t(result.ids.y);
  return hit;
}

}  // namespace eyeray
