#include "host/executors/samples.hpp"

#include <bit>
#include <limits>

#include "host/core/error.hpp"
#include "host/formula/formula.hpp"

namespace eyeray {

shader::QueryRay to_query_ray(const Query& ray, const Vec3& eye) {
  return {to_vec4(ray.o - eye), to_vec4(ray.d, ray.t_max)};
}

void check_ended(uint32_t flags) {
  if (flags & FLAG_ENDLESS)
    throw Error(ExitCode::timed_out, endless_formula("the function of an [[implicit]]"));
}

QueryHit to_query_hit(const shader::QueryHit& result) {
  check_ended(result.hit.z);
  const auto t = double(std::bit_cast<float>(result.hit.x));
  if (t >= double(T_MISS)) return {std::numeric_limits<double>::infinity(), -1, result.hit.z};
  return {t, result.hit.y == NONE ? -1 : int64_t{result.hit.y}, result.hit.z};
}

FirstHit to_first_hit(const shader::HitResult& result, const Vec3& eye) {
  check_ended(result.ids.z);
  FirstHit hit;
  hit.flags = result.ids.z;
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
