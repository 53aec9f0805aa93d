// The surfaces that light a scene, for integrators that choose one light and a point on it: calls the kind of emitter.
#ifndef EMITTER_GLSL
#define EMITTER_GLSL
#include "emitters/emitter_sample.glsl"
#include "emitters/light_bvh.glsl"
#include "textures/texture.glsl"
#include "records.h"

SHADER_BEGIN

EmitterSample sample_emitter(Emitter e, vec3 from, vec2 u) {
  EmitterSample point;
  point.p = emitter_origin(e);
  point.normal = vec3(0.0f, 0.0f, 0.0f);
  point.uv = vec2(0.0f, 0.0f);
#define SAMPLE_OF_EMITTER(name, number, itself) \
  if (e.kind == number) point = name##_emitter_sample(e, from, u);
  EMITTERS(SAMPLE_OF_EMITTER)
  return point;
}

// The density, by solid angle at `from`, with which sample_emitter chooses `point`.
float emitter_density(Emitter e, vec3 from, EmitterSample point) {
  float density = 0.0f;
#define DENSITY_OF_EMITTER(name, number, itself) \
  if (e.kind == number) density = name##_emitter_density(e, from, point);
  EMITTERS(DENSITY_OF_EMITTER)
  return density;
}

// The radiance that the point emits towards the origin of `direction`, which points at it.
vec3 emitter_radiance(Emitter e, EmitterSample point, vec3 direction) {
  vec3 light = e.radiance;
#if HAS_EMISSION_TEXTURES
  if (e.texture != NONE) {
    TextureContext at = context_of_uv(point.uv);
    at.p = point.p;
    vec3 color = vec3(1.0f, 1.0f, 1.0f);
    if (e.corners != NONE) {
      float wa = (1.0f - point.uv.x) - point.uv.y;
      vec4 c0 = bits_to_floats(load_vertex(e.corners));
      vec4 c1 = bits_to_floats(load_vertex(e.corners + 1u));
      vec4 c2 = bits_to_floats(load_vertex(e.corners + 2u));
      vec4 v = bits_to_floats(load_vertex(e.corners + 3u));
      at.uv = vec2((c0.w * wa + c1.w * point.uv.x) + c2.w * point.uv.y, (v.x * wa + v.y * point.uv.x) + v.z * point.uv.y);
#if HAS_SECOND_UV
      at.second_uv = at.uv;  // corners have those that the texture reads
#endif
      color = (vec3(c0) * wa + vec3(c1) * point.uv.x) + vec3(c2) * point.uv.y;
    }
    light = emission_texture(e.texture, at) * color;
  }
#endif
  if (HAS_ONE_SIDED_EMISSION == 1 && e.side * dot3(point.normal, direction) > 0.0f) light = vec3(0.0f, 0.0f, 0.0f);
  return light;
}

// True if it may light a point of that primitive.
bool may_light(Emitter e, uint primitive) {
  bool itself = true;
#define LIGHTS_ITSELF(name, number, itself_too) \
  if (e.kind == number) itself = itself_too;
  EMITTERS(LIGHTS_ITSELF)
  return itself || e.primitive != primitive;
}

// The probability of choosing an emitter that is in no BVH: it has the numbers, of 2^24, from the end of the one
// before.
float emitter_share(uint i) {
  uint begin = i == 0u ? 0u : load_emitter(i - 1u).end;
  return float(load_emitter(i).end - begin) * 5.9604645e-8f;
}

// The emitter that has the number.
uint emitter_with_number(uint number) {
  uint low = 0u;
  uint high = EMITTER_COUNT - 1u;
  for (uint turn = 0u; turn < 32u; turn++) {
    if (low >= high) break;
    uint middle = (low + high) >> 1u;
    bool before = number >= load_emitter(middle).end;
    low = before ? middle + 1u : low;
    high = before ? high : middle;
  }
  return low;
}

// The light that the number u · 2^24 chooses for p, where the normal is n, and how likely it is.
LightPick pick_light(Frame frame, vec3 p, vec3 n, float u) {
  uint number = uint(u * 16777216.0f);
  LightPick pick;
#if HAS_LIGHT_BVH
  uint others = 16777216u - frame.light_bvh_numbers;
  if (number >= others) {
    pick = pick_by_light_bvh(p, n, number - others, frame.light_bvh_numbers);
    pick.share = pick.share * (float(frame.light_bvh_numbers) * 5.9604645e-8f);
    return pick;
  }
#endif
  pick.light = emitter_with_number(number);
  pick.share = emitter_share(pick.light);
  return pick;
}

// The probability that the choice picks the light.
float light_share(Frame frame, vec3 p, vec3 n, uint light) {
#if HAS_LIGHT_BVH
  uint trail = load_emitter(light).trail;
  if (trail != NONE) return light_bvh_share(p, n, trail) * (float(frame.light_bvh_numbers) * 5.9604645e-8f);
#endif
  return emitter_share(light);
}

// The emitter that a primitive is, or NONE.
uint emitter_of(uint primitive) {
  uint low = LIGHT_COUNT;
  uint high = EMITTER_COUNT;
  for (uint turn = 0u; turn < 32u; turn++) {
    if (low >= high) break;
    uint middle = (low + high) >> 1u;
    bool before = load_emitter(middle).primitive < primitive;
    low = before ? middle + 1u : low;
    high = before ? high : middle;
  }
  uint found = low < EMITTER_COUNT ? low : 0u;
  return found >= LIGHT_COUNT && load_emitter(found).primitive == primitive ? found : NONE;
}

SHADER_END
#endif
