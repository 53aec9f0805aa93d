// The index of the pixel that is nearest to a point of the plane.
int clamped(ivec2 at, ivec2 size) {
  const ivec2 inside = clamp(at, ivec2(0), size - 1);
  return inside.y * size.x + inside.x;
}
