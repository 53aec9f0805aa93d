// How soon a point of the plane goes to infinity under z² + c, smoothly: the loop ends early where it does.
vec3 color(vec2 uv) {
  vec2 c = centre + (uv - 0.5) * width;
  vec2 z = vec2(0.0);
  float turns = 0.0;
  for (int i = 0; i < 40; i++) {
    if (dot(z, z) > 64.0) break;
    z = vec2(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + c;
    turns += 1.0;
  }
  if (dot(z, z) <= 64.0) return vec3(0.01, 0.01, 0.02);
  float smooth_turns = turns - log2(log2(dot(z, z)) / 6.0);
  return 0.5 - 0.5 * cos(0.45 * smooth_turns + vec3(0.3, 0.8, 1.5));
}
