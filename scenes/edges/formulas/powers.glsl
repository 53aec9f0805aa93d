// Roots, powers, exponentials and logarithms.
float f(vec3 p) {
  float roots = sqrt(p.x * p.x + 0.05) + inversesqrt(1.3 + p.z);
  float powers = pow(1.2 + p.x, 1.7) - pow(p.z, 3.0);
  float grown = exp(p.x) - exp2(1.5 * p.z);
  float slow = log(1.4 + p.z) - log2(2.0 + p.x);
  return p.y - 0.1 * (roots + powers + grown) - 0.15 * slow;
}
