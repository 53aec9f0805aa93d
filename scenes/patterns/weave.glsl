// Two sets of straps, over and under by turns.
vec3 strap(float across, float along, vec3 tint) {
  float round = 1.0 - 4.0 * across * across;
  return tint * (0.35 + 0.65 * round) * (0.75 + 0.25 * cos(6.2831853 * along));
}

vec3 color(vec2 uv) {
  vec2 p = uv * vec2(around, up);
  vec2 cell = floor(p);
  vec2 q = p - cell - 0.5;
  bool upright_above = mod(cell.x + cell.y, 2.0) < 0.5;
  float gap = 0.44;
  bool upright = abs(q.x) < gap;
  bool level = abs(q.y) < gap;
  if (upright && (upright_above || !level)) return strap(q.x, q.y, vec3(0.62, 0.4, 0.18));
  if (level) return strap(q.y, q.x, vec3(0.8, 0.62, 0.36));
  return vec3(0.03, 0.02, 0.01);
}
