#include "formula/cpp_language.hpp"

namespace eyeray::formula {

namespace {

// The functions of formula.glsl, by C's library and GLSL's definitions.
constexpr std::string_view functions = R"text(
#define ONE(name, value)                                                         \
  inline real fn_##name(real x) {                                                \
    return value;                                                                \
  }                                                                              \
  inline vec2 fn_##name(vec2 v) {                                                \
    return vec2(fn_##name(v.x), fn_##name(v.y));                                 \
  }                                                                              \
  inline vec3 fn_##name(vec3 v) {                                                \
    return vec3(fn_##name(v.x), fn_##name(v.y), fn_##name(v.z));                 \
  }                                                                              \
  inline vec4 fn_##name(vec4 v) {                                                \
    return vec4(fn_##name(v.x), fn_##name(v.y), fn_##name(v.z), fn_##name(v.w)); \
  }
#define TWO(name, value)                                                                             \
  inline real fn_##name(real x, real y) {                                                            \
    return value;                                                                                    \
  }                                                                                                  \
  inline vec2 fn_##name(vec2 a, vec2 b) {                                                            \
    return vec2(fn_##name(a.x, b.x), fn_##name(a.y, b.y));                                           \
  }                                                                                                  \
  inline vec3 fn_##name(vec3 a, vec3 b) {                                                            \
    return vec3(fn_##name(a.x, b.x), fn_##name(a.y, b.y), fn_##name(a.z, b.z));                      \
  }                                                                                                  \
  inline vec4 fn_##name(vec4 a, vec4 b) {                                                            \
    return vec4(fn_##name(a.x, b.x), fn_##name(a.y, b.y), fn_##name(a.z, b.z), fn_##name(a.w, b.w)); \
  }
#define THREE(name, value)                                                                     \
  inline real fn_##name(real x, real y, real z) {                                              \
    return value;                                                                              \
  }                                                                                            \
  inline vec2 fn_##name(vec2 a, vec2 b, vec2 c) {                                              \
    return vec2(fn_##name(a.x, b.x, c.x), fn_##name(a.y, b.y, c.y));                           \
  }                                                                                            \
  inline vec3 fn_##name(vec3 a, vec3 b, vec3 c) {                                              \
    return vec3(fn_##name(a.x, b.x, c.x), fn_##name(a.y, b.y, c.y), fn_##name(a.z, b.z, c.z)); \
  }                                                                                            \
  inline vec4 fn_##name(vec4 a, vec4 b, vec4 c) {                                              \
    return vec4(fn_##name(a.x, b.x, c.x), fn_##name(a.y, b.y, c.y), fn_##name(a.z, b.z, c.z),  \
                fn_##name(a.w, b.w, c.w));                                                     \
  }
#define LAST_ONE(name)                    \
  inline vec2 fn_##name(vec2 a, real b) { \
    return fn_##name(a, vec2(b));         \
  }                                       \
  inline vec3 fn_##name(vec3 a, real b) { \
    return fn_##name(a, vec3(b));         \
  }                                       \
  inline vec4 fn_##name(vec4 a, real b) { \
    return fn_##name(a, vec4(b));         \
  }
#define EACH(T)                                 \
  inline T fn_step(real a, T b) {               \
    return fn_step(T(a), b);                    \
  }                                             \
  inline T fn_clamp(T a, real b, real c) {      \
    return fn_clamp(a, T(b), T(c));             \
  }                                             \
  inline T fn_mix(T a, T b, real c) {           \
    return fn_mix(a, b, T(c));                  \
  }                                             \
  inline T fn_smoothstep(real a, real b, T c) { \
    return fn_smoothstep(T(a), T(b), c);        \
  }                                             \
  inline real fn_length(T a) {                  \
    return __builtin_sqrt(fn_dot(a, a));        \
  }                                             \
  inline real fn_distance(T a, T b) {           \
    return fn_length(a - b);                    \
  }                                             \
  inline T fn_normalize(T a) {                  \
    return a / fn_length(a);                    \
  }
ONE(abs, __builtin_fabs(x))
ONE(sign, real(x > 0) - real(x < 0))
ONE(floor, __builtin_floor(x))
ONE(ceil, __builtin_ceil(x))
ONE(trunc, __builtin_trunc(x))
ONE(round, __builtin_floor(x + 0.5))
ONE(fract, x - __builtin_floor(x))
ONE(sqrt, __builtin_sqrt(x))
ONE(inversesqrt, 1 / __builtin_sqrt(x))
ONE(radians, x * 0.017453292519943295)
ONE(degrees, x * 57.29577951308232)
ONE(sin, __builtin_sin(x))
ONE(cos, __builtin_cos(x))
ONE(tan, __builtin_tan(x))
ONE(asin, __builtin_asin(x))
ONE(acos, __builtin_acos(x))
ONE(atan, __builtin_atan(x))
TWO(atan, __builtin_atan2(x, y))
ONE(exp, __builtin_exp(x))
ONE(log, __builtin_log(x))
ONE(exp2, __builtin_exp2(x))
ONE(log2, __builtin_log2(x))
TWO(pow, __builtin_pow(x, y))
ONE(sinh, __builtin_sinh(x))
ONE(cosh, __builtin_cosh(x))
ONE(tanh, __builtin_tanh(x))
TWO(min, y < x ? y : x)
TWO(max, x < y ? y : x)
LAST_ONE(min)
LAST_ONE(max)
TWO(mod, x - y * __builtin_floor(x / y))
LAST_ONE(mod)
TWO(step, y < x ? 0.0 : 1.0)
THREE(clamp, fn_min(fn_max(x, y), z))
THREE(mix, x + (y - x) * z)
inline real hermite(real t) {
  return t * t * (3 - 2 * t);
}
THREE(smoothstep, hermite(fn_clamp((z - x) / (y - x), 0, 1)))
inline real fn_dot(real a, real b) {
  return a * b;
}
inline real fn_dot(vec2 a, vec2 b) {
  return a.x * b.x + a.y * b.y;
}
inline real fn_dot(vec3 a, vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline real fn_dot(vec4 a, vec4 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
EACH(vec2)
EACH(vec3)
EACH(vec4)
inline real fn_length(real a) {
  return __builtin_fabs(a);
}
inline real fn_distance(real a, real b) {
  return __builtin_fabs(a - b);
}
inline vec3 fn_cross(vec3 a, vec3 b) {
  return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
inline vec2 fn_reflect(vec2 v, vec2 n) {
  return v - n * (2 * fn_dot(n, v));
}
inline vec3 fn_reflect(vec3 v, vec3 n) {
  return v - n * (2 * fn_dot(n, v));
}
)text";

}  // namespace

std::string_view cpp_functions() {
  return functions;
}

}  // namespace eyeray::formula
