// A twisted column with rounded edges. f is negative inside. The scene's `lipschitz` bounds its slope.
float f(vec3 p) {
  float angle = twist * p.y;
  float c = cos(angle);
  float s = sin(angle);
  vec3 q = vec3(c * p.x - s * p.z, p.y - 0.8, s * p.x + c * p.z);

  // Distance of q from a box, after Quilez.
  vec3 beyond = abs(q) - vec3(0.4, 0.8, 0.4) + edge;
  return length(max(beyond, 0.0)) + min(max(beyond.x, max(beyond.y, beyond.z)), 0.0) - edge;
}
