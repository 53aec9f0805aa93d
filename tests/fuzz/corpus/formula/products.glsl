float f(vec3 p) {
  uint u = 4278190081u;
  int k = 0;
  for (int i = 0; i < 3; i++) { u = u * u; k += 7 / i + 7 % i; }
  return p.x + float(u >> 9u) + float(k);
}
