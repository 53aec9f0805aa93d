// What bends, so little that differences do not see it.
float f(vec3 p) {
  float bends = pow(max(p.x, 0.0), 5.0) - pow(abs(min(p.z, 0.0)), 5.0) + 0.1 * pow(clamp(p.x + p.z, 0.0, 3.0), 5.0);
  float mixed = mix(p.x, -p.z, 0.3) + 2.0 * smoothstep(-2.0, 2.0, p.z);
  return p.y - 0.15 * (bends + mixed);
}
