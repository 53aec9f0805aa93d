// Square tiles of four glazes, set in mortar: the colour at uv, in linear RGB from 0 to 1.
float random(vec2 cell) {
  uint h = uint(int(cell.x)) * 2654435761u ^ uint(int(cell.y)) * 2246822519u;
  h = (h ^ h >> 15u) * 2654435761u;
  return float(h >> 8u) / 16777216.0;
}

vec3 color(vec2 uv) {
  vec2 cell = floor(uv * tiles);
  vec2 q = abs(uv * tiles - cell - 0.5);
  if (max(q.x, q.y) > 0.5 * (1.0 - joint)) return vec3(0.22, 0.2, 0.18);

  vec3 glazes[4] = vec3[4](vec3(0.75, 0.7, 0.58), vec3(0.12, 0.3, 0.34), vec3(0.55, 0.62, 0.6), vec3(0.8, 0.55, 0.22));
  float pick = random(cell);
  return glazes[int(4.0 * pick)] * (0.85 + 0.15 * fract(16.0 * pick));
}
