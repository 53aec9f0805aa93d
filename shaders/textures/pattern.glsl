// Patterns in space: a share of [0, 1] at each point, and a colour for each share. In vertices: three rows of the map from the eye's space
// to the pattern's; the values that the pattern's .glsl lists; then the colours, each with its share.
#ifndef PATTERN_GLSL
#define PATTERN_GLSL
#include "math/math.glsl"
#include "math/rng.glsl"
#include "records.h"
#include "textures/context.glsl"

SHADER_BEGIN

uint pattern_first_word(Texture texture) { return texture.c.x; }  // in vertices
uint pattern_colors(Texture texture) { return texture.c.y; }  // how many

vec4 pattern_word(Texture texture, uint i) { return bits_to_floats(load_vertex(pattern_first_word(texture) + i)); }
vec4 pattern_parameters(Texture texture) { return pattern_word(texture, 3u); }

vec3 pattern_point(Texture texture, vec3 p) {
  vec4 x = pattern_word(texture, 0u);
  vec4 y = pattern_word(texture, 1u);
  vec4 z = pattern_word(texture, 2u);
  return vec3(dot3(vec3(x), p) + x.w, dot3(vec3(y), p) + y.w, dot3(vec3(z), p) + z.w);
}

// Interpolates from colour to colour; two at one share are a step.
vec3 pattern_color(Texture texture, float share) {
  vec4 before = pattern_word(texture, 4u);
  vec3 color = vec3(before);
  for (uint i = 1u; i < pattern_colors(texture); i++) {
    vec4 next = pattern_word(texture, 4u + i);
    float width = next.w - before.w;
    float s = width > 0.0f ? minimum(maximum((share - before.w) / width, 0.0f), 1.0f) : (share < next.w ? 0.0f : 1.0f);
    color = color + (vec3(next) - color) * s;
    before = next;
  }
  return color;
}

float fraction(float x) { return x - floor(x); }
// 0 at whole numbers, 1 half way between them.
float triangle_wave(float x) { return 1.0f - abs(2.0f * fraction(x) - 1.0f); }

// The number of a cell, by its lower corner: whole numbers.
uint cell_hash(vec3 corner) {
  uint x = uint(int(minimum(maximum(corner.x, -1.0e9f), 1.0e9f)));
  uint y = uint(int(minimum(maximum(corner.y, -1.0e9f), 1.0e9f)));
  uint z = uint(int(minimum(maximum(corner.z, -1.0e9f), 1.0e9f)));
  return pcg_hash(x + pcg_hash(y + pcg_hash(z)));
}

// The component of `way` along one of twelve slopes, the edges of a cube: Perlin's, "Improving Noise" (2002).
float slope_along(uint hash, vec3 way) {
  uint h = hash & 15u;
  float u = h < 8u ? way.x : way.y;
  float v = h < 4u ? way.y : (h == 12u || h == 14u) ? way.x : way.z;
  return ((h & 1u) == 0u ? u : -u) + ((h & 2u) == 0u ? v : -v);
}

float fade(float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }

// Perlin's gradient noise, within −1 and 1, 0 at the corners of cells.
float gradient_noise(vec3 p) {
  vec3 corner = vec3(floor(p.x), floor(p.y), floor(p.z));
  vec3 in_cell = p - corner;
  vec3 share = vec3(fade(in_cell.x), fade(in_cell.y), fade(in_cell.z));
  float value = 0.0f;
  for (uint i = 0u; i < 8u; i++) {
    vec3 at = vec3(float(i & 1u), float((i >> 1u) & 1u), float(i >> 2u));
    float weight = (at.x > 0.0f ? share.x : 1.0f - share.x) * (at.y > 0.0f ? share.y : 1.0f - share.y) *
                   (at.z > 0.0f ? share.z : 1.0f - share.z);
    value += weight * slope_along(cell_hash(corner + at), in_cell - at);
  }
  return value;
}

// Octaves of the noise, each twice as fine as the one before and half as strong.
float turbulence(vec3 p, float octaves) {
  float sum = 0.0f;
  float scale = 1.0f;
  for (float i = 0.0f; i < octaves; i += 1.0f) {
    sum += gradient_noise(p * scale) / scale;
    scale = 2.0f * scale;
  }
  return sum;
}

SHADER_END
#endif
