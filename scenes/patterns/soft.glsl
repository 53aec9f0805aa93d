// 1 in the middle of a square of uv, and 0 from its circle on.
vec3 color(vec2 uv) {
  vec2 p = 2.0 * uv - 1.0;
  float inside = max(1.0 - dot(p, p), 0.0);
  return vec3(inside * inside);
}
