// Definitions that let one source be GLSL and C++. Only this file has such tricks; everything else is written in the common subset:
// float literals end in f, unsigned ones in u; no swizzles (vec3(v) takes the first three of a vec4).
// No struct constructors; no implicit conversions.
#ifndef LANGUAGE_H
#define LANGUAGE_H

#ifdef __cplusplus

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#define INOUT(T) T&
#define OUT(T) T&
#define UNROLL
#define INLINE inline

namespace eyeray::engine::shader {

using uint = uint32_t;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline float abs(float x) { return std::fabs(x); }
inline float floor(float x) { return std::floor(x); }
inline float sqrt(float x) { return std::sqrt(x); }
inline uint floatBitsToUint(float x) { return __builtin_bit_cast(uint, x); }
inline int floatBitsToInt(float x) { return __builtin_bit_cast(int, x); }
inline float uintBitsToFloat(uint x) { return __builtin_bit_cast(float, x); }

}  // namespace eyeray::engine::shader

#define SHADER_BEGIN namespace eyeray::engine::shader {
#define SHADER_END }

#else

#define INOUT(T) inout T
#define OUT(T) out T
#define UNROLL [[unroll]]
#define INLINE
#define SHADER_BEGIN
#define SHADER_END

#endif

// PROBE shows a value to `eyeray probe`, as a line `name = value` of the ray that is traced: a float, int, uint, bool or vector of
// floats. It may stand wherever a statement may. PROBE_RAY: the values after it belong to a new ray (records.h, RAY_…), of a shadow ray
// with its light's number, after so many reflections and refractions. PROBE_BACK: to the last one there again, with NONE to the pixel.
// Without a probe nothing is left of them; kernels/probe.glsl and the twin define them otherwise.
#ifndef PROBE
#define PROBE(name, value)
#define PROBE_RAY(kind, number, depth)
#define PROBE_BACK(depth)
#endif
#endif
