// The distance of the nearest point, where each cell of side 1 has one at a random position: Worley, "A Cellular Texture Basis
// Function" (1996).
#ifndef TEXTURES_CELLS_GLSL
#define TEXTURES_CELLS_GLSL
#include "textures/pattern.glsl"

SHADER_BEGIN

float cells_share(Texture texture, vec3 p) {
  vec3 corner = vec3(floor(p.x), floor(p.y), floor(p.z));
  float nearest = 1.0f;
  for (uint i = 0u; i < 27u; i++) {
    uint layer = i / 9u;
    uint row = (i - 9u * layer) / 3u;
    uint column = i - 9u * layer - 3u * row;
    vec3 cell = corner + vec3(float(column) - 1.0f, float(row) - 1.0f, float(layer) - 1.0f);
    uint hash = cell_hash(cell);
    uint second = pcg_hash(hash);
    vec3 way = cell + vec3(unit_float(hash), unit_float(second), unit_float(pcg_hash(second))) - p;
    nearest = minimum(nearest, dot3(way, way));
  }
  return sqrt(nearest);
}

vec3 cells_color(Texture texture, TextureContext point) {
  return pattern_color(texture, cells_share(texture, pattern_point(texture, point.p)));
}
float cells_alpha(Texture texture, TextureContext point) { return cells_color(texture, point).x; }

SHADER_END
#endif
