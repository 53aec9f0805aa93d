// The part of the ABI that comes back: results of kernels, and records that they hand on to others; by the rules of records.h, which
// includes it.
#ifndef RESULT_RECORDS_H
#define RESULT_RECORDS_H

#include "language.h"

SHADER_BEGIN

#define REFRACTED_SHIFT 8u
#define HITS_BITS 16u
#define WHOLE_BACKGROUND 32768u  // a background_of that is 1
#define TOTAL_SHIFT 20u

// One sample of one pixel, 32 bytes.
struct SampleResult {
  vec3 color;
  uint trail;  // trail of a random walk (integrators/trail.glsl); else 1
  uint rays;
  uint hits;        // with FLAG_BACKGROUND in the lowest HITS_BITS, below background_of
  uint flags;       // with RAY_KINDS below refracted_of
  uint iterations;  // iterations of loops; with RAY_KINDS reflected_of and total_reflections_of instead
};
INLINE SampleResult sample_result(vec3 color, uvec4 counts, uint trail) {
  SampleResult result;
  result.color = color;
  result.trail = trail;
  result.rays = counts.x;
  result.hits = counts.y;
  result.flags = counts.z;
  result.iterations = counts.w;
  return result;
}
INLINE uvec4 counts_of(SampleResult result) { return uvec4(result.rays, result.hits, result.flags, result.iterations); }
// With RAY_KINDS: how many of its rays were refracted and reflected, and how often a reflection was total.
INLINE uint flags_of(SampleResult result) { return result.flags & ((1u << REFRACTED_SHIFT) - 1u); }
INLINE uint refracted_of(SampleResult result) { return result.flags >> REFRACTED_SHIFT; }
INLINE uint reflected_of(SampleResult result) { return result.iterations & ((1u << TOTAL_SHIFT) - 1u); }
INLINE uint total_reflections_of(SampleResult result) { return result.iterations >> TOTAL_SHIFT; }
// With FLAG_BACKGROUND: the share of the background's light that comes straight to the eye, in units of 1 / WHOLE_BACKGROUND.
INLINE uint background_of(SampleResult result) { return result.hits >> HITS_BITS; }

// A denoiser's auxiliary values of one sample of one pixel, 32 bytes.
struct AuxiliaryResult {
  vec3 albedo;
  uint flags;
  vec3 normal;
  uint unused;
};

// The first hit of one pixel, 80 bytes. A miss has primitive = material = NONE and t = T_MISS.
struct HitResult {
  vec3 position;  // relative to the eye
  float t;
  vec3 normal;
  float u;
  vec3 normal_geometric;
  float v;
  float cosine;  // cosine of the angle between normal_geometric and the way back along the ray
  uint primitive;
  uint material;
  uint flags;
  uint nodes;  // with SEARCH_COST, also of a miss: of BVHs, visited …
  uint tests;  // … and primitives tested
  uint unused_0;
  uint unused_1;
};
// kernels/query.comp.glsl: a ray, 32 bytes.
struct QueryRay {
  vec3 origin;
  float unused;
  vec3 direction;
  float t_max;  // up to which occlusion counts
};
// The answer to a query, 16 bytes. If the query is for any hit: 0 or T_MISS, NONE, flags, occlusion.
struct QueryHit {
  float t;
  uint primitive;  // or NONE
  uint flags;
  uint occlusion;
};

// Rays that kernels/cooperative/packet.comp.glsl traces together. More share more of the work, and take longer to compile.
#define PACKET 32

// The hit of the ray of one sample of a pixel, 32 bytes.
struct PacketHit {
  float t;
  uint slot;
  uint id;
  uint flags;
  float u;
  float v;
  uint unused_0;
  uint unused_1;
};

// The state from which a pixel's path goes on, 80 bytes.
struct PathState {
  vec3 origin;
  uint media;
  vec3 direction;
  float density;
  vec3 throughput;
  uint pixel;
  vec3 normal;
  uint unused_0;
  vec3 point;
  uint unused_1;
};

// A value of a pixel's rays that a probe records, 32 bytes. `name` of the buffer's first record is the number that there would be if all
// had room.
struct ProbeRecord {
  uint name;  // PROBED_name (features.h), or PROBE_OPENS_RAY, PROBE_RETURNS
  uint line;  // line of the shader's file
  uint type;
  uint size;    // components
  uvec4 value;  // the bits of each; of a ray kind, number and depth
};
#define PROBE_OPENS_RAY 0xffffffffu
#define PROBE_RETURNS 0xfffffffeu
#define PROBE_FLOAT 0u
#define PROBE_INT 1u
#define PROBE_UINT 2u
#define PROBE_BOOL 3u
// Kinds of rays; core/ray_tree.hpp names them for the host.
#define RAY_EYE 1u
#define RAY_REFLECTED 2u
#define RAY_REFRACTED 3u
#define RAY_SHADOW 4u

// Bits of the flags of results; core/pixel.hpp names them for the host.
#define FLAG_MEDIA_OVERFLOW 1u
#define FLAG_STACK_OVERFLOW 2u
#define FLAG_LOOP_BUDGET 4u
#define FLAG_ITERATION_LIMIT 8u
#define FLAG_ENDLESS 16u  // a formula's loops took more than FORMULA_ITERATIONS iterations in one call
#define FLAG_CUT_OFF 32u  // with RAY_KINDS, and no fault: max_depth ended the path
#define FLAG_BACKGROUND 128u  // no fault: a transparent picture's camera ray reaches the background in a straight line
// A loop of a user's shaders was stopped (STOPPED_LOOPS). Its bit among those from REFRACTED_SHIFT on names it, unless RAY_KINDS.
#define FLAG_ENDLESS_LOOP 64u

SHADER_END

#ifdef __cplusplus
static_assert(sizeof(eyeray::engine::shader::SampleResult) == 32);
static_assert(sizeof(eyeray::engine::shader::AuxiliaryResult) == 32);
static_assert(sizeof(eyeray::engine::shader::HitResult) == 80);
static_assert(sizeof(eyeray::engine::shader::QueryRay) == 32);
static_assert(sizeof(eyeray::engine::shader::QueryHit) == 16);
static_assert(sizeof(eyeray::engine::shader::PacketHit) == 32);
static_assert(sizeof(eyeray::engine::shader::PathState) == 80);
static_assert(sizeof(eyeray::engine::shader::ProbeRecord) == 32);
#endif
#endif
