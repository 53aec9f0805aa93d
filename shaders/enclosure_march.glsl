// The first root along a ray, from enclosures of the function (enclosure.glsl): piece after piece, each as long as its enclosure can do
// with. Whoever marches asks for the function's enclosure on march_middle(march) ± march_half(march) until march.over.
#ifndef ENCLOSURE_MARCH_GLSL
#define ENCLOSURE_MARCH_GLSL
#include "enclosure.glsl"

SHADER_BEGIN

struct March {
  float t;        // no root lies before it
  float h;        // half the length of the piece that is next
  float end;      // of the ray
  float finest;   // a piece with a smaller h is not told from a point
  float certain;  // a root lies before it, for certain; beyond `end` where none is known
  float root;     // -1 where there is none
  bool over;
};

March march_begin(float start, float end, float finest) {
  March march;
  march.t = start;
  march.h = 0.125f * (end - start);
  march.end = end;
  march.finest = finest;
  march.certain = 2.0f * abs(end) + 1.0f;
  march.root = -1.0f;
  march.over = !(start < end);
  return march;
}

float march_middle(March march) { return march.t + march.h; }
// A little more than h, so that no root falls between two pieces.
float march_half(March march) { return march.h + 4.0f * EPSILON * (abs(march.t) + 2.0f * march.h); }

// The march after the piece on which the function is a + b·s ± e.
March march_on(March march, vec3 f) {
  float middle = march_middle(march);
  float h = march_half(march);
  bool none = abs(f.x) > abs(f.y) + f.z;
  // Only where |a + b·s| ≤ e can a root be; one is, by the signs at both ends, where the line leads from -e to e within the piece.
  float centre = -f.x / f.y;
  float width = f.z / abs(f.y) * ENCLOSURE_GROW + 8.0f * EPSILON * (1.0f + abs(centre));
  float left = middle + h * maximum(-1.0f, centre - width);
  float right = middle + h * minimum(1.0f, centre + width);
  float length = right - left;
  bool crosses = abs(f.y) > abs(f.x) + f.z;

  March next = march;
  next.t = none ? middle + march.h : maximum(march.t, left);
  next.certain = crosses ? minimum(march.certain, right) : march.certain;
  // As narrow as float32 tells: the root is where the line has it; or, where the sign says nothing, the function touches zero there.
  bool narrow = crosses && length <= 16.0f * march.finest;
  bool touches = !none && march.h <= march.finest;
  float between = next.certain - next.t <= 128.0f * march.finest ? 0.5f * (next.t + next.certain) : middle;
  next.root = narrow ? middle + h * minimum(1.0f, maximum(-1.0f, centre)) : touches ? between : -1.0f;
  next.over = narrow || touches || next.t >= march.end;

  float closer = maximum(0.625f * length, crosses ? 0.0f : 0.125f * march.h);
  next.h = none ? 2.0f * march.h : minimum(closer, 0.5f * march.h);
  next.h = minimum(maximum(next.h, march.finest), maximum(0.5f * (march.end - next.t), march.finest));
  return next;
}

SHADER_END
#endif
