// Those of coarse.glsl, with their slope.
float f(vec3 p) {
  return (p.y + 128.0) - (128.0 * tanh(100.0 + p.x) + 0.25 * sin(2.5 * p.x) * cos(2.0 * p.z));
}
vec3 gradient(vec3 p) {
  return vec3(-0.625 * cos(2.5 * p.x) * cos(2.0 * p.z), 1.0, 0.5 * sin(2.5 * p.x) * sin(2.0 * p.z));
}
