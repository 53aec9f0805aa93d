// Angles and what belongs to them, each a slope of its own.
float f(vec3 p) {
  float across = sin(degrees(0.06 * p.x)) + cos(radians(200.0 * p.z)) + tan(0.9 * p.z);
  float back = asin(0.9 * p.x) - acos(0.85 * p.z) + atan(3.0 * p.x) + 2.0 * atan(p.z, 1.5 + p.x);
  float grown = sinh(1.2 * p.x) - cosh(1.1 * p.z) + tanh(2.0 * p.z);
  return p.y - 0.1 * (across + back + grown);
}
