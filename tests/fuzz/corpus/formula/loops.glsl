float f(vec3 p) {
  float s = 0.0;
  for (int i = 0, k; i < 10; i++) { i &= 3; if (k > 5) continue; k = i; s += p.x; if (s > 100.0) break; }
  while (s > p.y) { s -= length(p) * 0.5 + size; if (s != s) return dot(p, p); }
  return smoothstep(-1.0, 1.0, s) + mix(p, p.zyx, 0.25).y;
}
