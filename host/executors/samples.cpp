#include "host/executors/samples.hpp"

#include <limits>

#include "host/core/error.hpp"
#include "host/formula/formula.hpp"

namespace eyeray::engine::executors {

// The host names the shaders' flags where it knows no records (core/pixel.hpp).
static_assert(media_overflow == FLAG_MEDIA_OVERFLOW && stack_overflow == FLAG_STACK_OVERFLOW);
static_assert(loop_budget == FLAG_LOOP_BUDGET && iteration_limit == FLAG_ITERATION_LIMIT);
static_assert(endless == FLAG_ENDLESS);

AuxiliarySample to_auxiliary(const shader::AuxiliaryResult& result) {
  check_ended(result.flags);
  return {Vec3(result.albedo), Vec3(result.normal), result.flags};
}

shader::QueryRay to_query_ray(const Query& ray, const Vec3& eye) {
  return {glm::vec3(ray.o - eye), 0.0f, glm::vec3(ray.d), float(ray.t_max)};
}

void check_ended(uint32_t flags) {
  if (flags & FLAG_ENDLESS)
    throw Error(ExitCode::timed_out, formula::endless_formula("a function of the scene"));
}

QueryHit to_query_hit(const shader::QueryHit& result) {
  check_ended(result.flags);
  const auto t = double(result.t);
  if (t >= double(T_MISS)) return {std::numeric_limits<double>::infinity(), -1, result.flags};
  return {t, result.primitive == NONE ? -1 : int64_t{result.primitive}, result.flags};
}

FirstHit to_first_hit(const shader::HitResult& result, const Vec3& eye, bool search_cost) {
  check_ended(result.flags);
  FirstHit hit;
  hit.flags = result.flags;
  if (search_cost) hit.cost = {int64_t{result.nodes}, int64_t{result.tests}};
  if (result.primitive == NONE) return hit;
  hit.t = double(result.t);
  hit.position = eye + Vec3(result.position);
  hit.normal = Vec3(result.normal);
  hit.normal_geometric = Vec3(result.normal_geometric);
  hit.cosine = double(result.cosine);
  hit.uv = {double(result.u), double(result.v)};
  hit.primitive = int32_t(result.primitive);
  hit.material = int32_t(result.material);
  return hit;
}

}  // namespace eyeray::engine::executors
