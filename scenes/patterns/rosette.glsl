// An alpha: a rose window, cut out of a disk, whose middle is (½, ½) in uv and its rim ½ away.
vec3 color(vec2 uv) {
  vec2 q = 2.0 * uv - 1.0;
  float r = length(q);
  float petal = abs(cos(6.0 * atan(q.y, q.x)));
  bool hub = r < 0.2;
  bool rim = r > 0.88;
  bool ring = abs(r - 0.56) < 0.03;
  bool spoke = petal < 0.24;
  return vec3(hub || rim || ring || spoke ? 1.0 : 0.0);
}
