// What jumps, where a wave begins anew or the height is flat.
float f(vec3 p) {
  const float turn = 6.28318531;
  float waves = sin(turn * fract(1.7 * p.x)) + sin(turn * mod(p.x + p.z, 1.2) / 1.2) + sin(turn * (1.7 * p.z - round(1.7 * p.z)));
  waves += cos(turn * (ceil(1.9 * p.z) - 1.9 * p.z)) + cos(turn * (1.6 * p.x - trunc(1.6 * p.x))) + sin(turn * (1.3 * p.z - floor(1.3 * p.z)));
  float bends = sign(p.z) * pow(p.z, 5.0) - step(0.2, p.x) * pow(p.x - 0.2, 4.0);
  return p.y - 0.04 * waves - 0.4 * bends;
}
