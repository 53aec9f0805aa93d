// The surfaces that light a scene, for integrators that choose one light and a place on it: asks the kind of emitter.
#ifndef EMITTER_GLSL
#define EMITTER_GLSL
#include "emitters/emitter_sample.glsl"
#include "records.h"

SHADER_BEGIN

EmitterSample sample_emitter(Emitter e, vec3 from, vec2 u) {
  EmitterSample place;
  place.p = vec3(e.a);
  place.normal = vec3(0.0f, 0.0f, 0.0f);
#define SAMPLE_OF_EMITTER(name, number, itself) \
  if (e.kind == number) place = name##_emitter_sample(e, from, u);
  EMITTERS(SAMPLE_OF_EMITTER)
  return place;
}

// By solid angle at `from`, that sample_emitter chooses `place`.
float emitter_density(Emitter e, vec3 from, EmitterSample place) {
  float density = 0.0f;
#define DENSITY_OF_EMITTER(name, number, itself) \
  if (e.kind == number) density = name##_emitter_density(e, from, place);
  EMITTERS(DENSITY_OF_EMITTER)
  return density;
}

// Whether it may light a point of that primitive.
bool may_light(Emitter e, uint primitive) {
  bool itself = true;
#define LIGHTS_ITSELF(name, number, itself_too) \
  if (e.kind == number) itself = itself_too;
  EMITTERS(LIGHTS_ITSELF)
  return itself || e.primitive != primitive;
}

// How likely an emitter is chosen: it has the numbers of 2^24 from where the one before ends.
float emitter_share(uint i) {
  uint begin = i == 0u ? 0u : load_emitter(i - 1u).end;
  return float(load_emitter(i).end - begin) * 5.9604645e-8f;
}

// The emitter that has the number u · 2^24.
uint emitter_chosen_by(float u) {
  uint number = uint(u * 16777216.0f);
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
