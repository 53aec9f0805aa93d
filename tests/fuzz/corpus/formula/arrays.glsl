const vec2 t[3] = vec2[3](vec2(1.0, 0.1 * 3.0), vec2(7 / 0), vec2(-7 % 3, 1 << 33));
float g(float a[4], inout float x, out vec2 v) { a[0] = 9.0; x += v.y; v = t[int(x)]; return a[3]; }
float f(vec3 p) {
  float a[4], b[4] = float[](1.0, 2.0, 3.0, 4.0);
  vec2 v;
  for (int i = 0; i < 4; i++) { float fresh; a[i] = fresh; fresh = 0.75; b[i * int(p.x)] += p.y; }
  float s = g(a, p.x, v) + g(p.y > 0.0 ? a : b, p.z, p.xy);
  p.xy[int(p.z)] = 4.0;
  return a == b ? s : s + v.y + p[int(p.x * 1e9)];
}
