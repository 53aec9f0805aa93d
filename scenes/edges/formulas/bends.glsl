// What bends, and conditions that nothing jumps at.
float f(vec3 p) {
  float bends = abs(p.x + p.z) + clamp(2.0 * p.z, -0.5, 0.5) + min(p.x, p.z) - max(p.x, 0.3 - p.z);
  float mixed = mix(p.x, -p.z, 0.3) + smoothstep(-0.5, 0.5, p.z) + step(0.2, p.x) * (p.x - 0.2);
  float chosen = p.x > 0.25 && !(p.z <= 0.25) ? (p.x - 0.25) * (p.z - 0.25) : 0.0;
  chosen += p.x < -0.4 || p.x > 0.6 ? (p.x + 0.4) * (p.x - 0.6) : 0.0;
  return p.y - 0.1 * (bends + mixed) - 0.3 * chosen;
}
