// Tiles of six corners: the nearer of the two grids' centres is the tile's. `joint`: of the way from a tile's centre to its edge.
const vec2 grid = vec2(1.7320508, 3.0);

float shade(vec2 cell) {
  uint h = uint(int(cell.x)) * 2654435761u ^ uint(int(cell.y)) * 2246822519u;
  h = (h ^ h >> 15u) * 2654435761u;
  return float(h >> 24u) / 255.0;
}

vec3 color(vec2 uv) {
  vec2 p = uv * tiles;
  vec2 first = floor(p / grid + 0.5);
  vec2 second = floor(p / grid);
  vec2 from_first = p - first * grid;
  vec2 from_second = p - (second + 0.5) * grid;
  bool is_first = dot(from_first, from_first) < dot(from_second, from_second);
  vec2 q = abs(is_first ? from_first : from_second);
  vec2 cell = is_first ? 2.0 * first : 2.0 * second + 1.0;
  float edge = max(q.x, 0.5 * q.x + 0.8660254 * q.y) / 0.8660254;
  return edge > 1.0 - joint ? dark : mix(light, 0.75 * light, shade(cell));
}
