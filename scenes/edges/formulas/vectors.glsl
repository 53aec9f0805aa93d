// Vectors.
float f(vec3 p) {
  float lengths = length(p.xz - vec2(0.3, -0.2)) - distance(p, vec3(-0.5, -1.5, 0.2));
  float directions = 3.0 * normalize(p + vec3(0.0, 2.0, 0.0)).x + reflect(p, normalize(vec3(1.0, 3.0, 2.0))).z;
  float products = dot(p, vec3(0.3, 0.5, -0.2)) + cross(p, vec3(0.5, 2.0, -1.0)).y;
  return p.y - 0.2 * (lengths + directions + products);
}
