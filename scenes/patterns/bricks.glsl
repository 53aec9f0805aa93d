// Bricks in a running bond on a `wall`: `size` of one with its joint, every second row moved by half of it.
vec3 color(vec2 uv) {
  vec2 p = uv * wall;
  float row = floor(p.y / size.y);
  float along = p.x / size.x + 0.5 * mod(row, 2.0);
  float column = floor(along);
  vec2 within = vec2(along - column, p.y / size.y - row) * size;
  bool mortar = within.x < joint || within.y < joint;
  float tone = fract(0.37 * column + 0.61 * row + 0.113 * column * row);
  return mortar ? vec3(0.72, 0.7, 0.66) : mix(vec3(0.5, 0.17, 0.1), vec3(0.62, 0.27, 0.16), tone);
}
