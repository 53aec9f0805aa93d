// Hills whose height float32 knows to 1e-5, since it is added to something large; that is 128 only where tanh takes any number.
float f(vec3 p) {
  return (p.y + 128.0) - (128.0 * tanh(100.0 + p.x) + 0.25 * sin(2.5 * p.x) * cos(2.0 * p.z));
}
