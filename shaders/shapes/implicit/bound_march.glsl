// The first root along a ray, from affine bounds of the function (math/affine_bound.glsl): piece after piece, each as long as its affine bound
// allows. The caller of the march evaluates the function's affine bound on march_middle(march) ± march_half(march) until march.over.
// A root is where the sign changes. No change is overlooked but within a piece passed over: one as short as can be, or one whose affine
// bound is hardly sharper than that of a point in it. There the function is zero within the bound of float32's rounding. At worst that is hundreds
// of times the actual rounding. So the deviation of neighbouring points from a line is measured first, and where it is small, it counts instead. If
// the sign is another than before, the root among the pieces that were passed over is narrowed down by the signs that f has in float32.
#ifndef ENCLOSURE_MARCH_GLSL
#define ENCLOSURE_MARCH_GLSL
#include "math/affine_bound.glsl"

SHADER_BEGIN

// The h, in finest pieces, of the first piece that may be passed over, and of the longest one. Each piece is up to twice as long as the one before,
// so that little is lost where the function jumped and rounding was not the cause.
#define MARCH_FIRST_PASS 64.0f
#define MARCH_LONGEST_PASS 16384.0f
#define MARCH_BLUNT 1.5f   // e over that of a point: above it, shorter pieces give more information
#define MARCH_LIKELY 0.25f // |a| over e: where more is, its sign is the function's
// The actual rounding: the deviation of the function from a line at so many points, times three, or a share of their e if that is more.
#define MARCH_POINTS 6u
#define MARCH_STRAYS 3.0f
#define MARCH_LEAST_SHARE 0.015625f
#define MARCH_ROUNDS 2.0e-4f  // where that share is less, e is no rounding, but the choices of undecided conditions

struct March {
  float t;        // up to here the sign is known, but for the pieces passed over
  float h;        // half the length of the piece that is next
  float end;      // end of the ray
  float finest;   // a piece with a smaller h cannot be distinguished from a point; at least an ulp of t, so that every piece leads on
  float sign;     // the last that was known; 0 where none was
  float unknown;  // from here to t pieces were passed over
  float coarse;   // e of the piece before, where that was undecided; beyond all else
  float noise;    // e of a point nearby; 0 where it is not known
  float pass;     // the h of a piece that may be passed over
  float waiting;  // while points are evaluated: h of the piece after that; else 0
  uint points;    // how many are still to be evaluated
  float value;    // a of the last of them, …
  float rise;     // … less that of the one before it
  float stray;    // their greatest second difference
  float share;    // the part of a point's e that is taken for rounding: 1 where all of it is; below 0 while points are evaluated, 0 before
  float root;     // once found
  float low;      // while that is narrowed down among pieces that were passed over: before it, …
  float high;     // … and past it
  float past;     // from where on it is passed, where it was found within a piece; else before t
  float beyond;   // the sign past it
  bool found;     // not over yet: narrowed down
  bool over;
};

// `sign`: at the start; 0 where it is not known.
March march_begin(float start, float end, float sign, float finest) {
  March march;
  march.t = start;
  march.h = 0.125f * (end - start);
  march.end = end;
  march.finest = maximum(finest, 2.0f * EPSILON * maximum(abs(start), abs(end)));
  march.sign = sign;
  march.unknown = start;
  march.coarse = 3.0e38f;
  march.noise = 0.0f;
  march.pass = MARCH_FIRST_PASS * finest;
  march.waiting = 0.0f;
  march.points = 0u;
  march.value = 0.0f;
  march.rise = 0.0f;
  march.stray = 0.0f;
  march.share = 0.0f;
  march.root = start;
  march.low = start;
  march.high = start;
  march.past = start;
  march.beyond = 0.0f;
  march.found = false;
  march.over = !(start < end);
  return march;
}

float march_middle(March march) {
  float ahead = march.points > 0u ? float(2u * march.points - 1u) : 1.0f;
  return march.found ? 0.5f * (march.low + march.high) : march.t + march.h * ahead;
}
// A little more than h, so that no root falls between two pieces.
float march_half(March march) { return march.h + 4.0f * EPSILON * (abs(march.t) + 2.0f * march.h); }

// The march after the piece on which the function is a + b·s ± e.
March march_on(March march, vec3 f) {
  March next = march;
  if (march.found) {
    bool before = (f.x < 0.0f) != (march.beyond < 0.0f);
    next.low = before ? march_middle(march) : march.low;
    next.high = before ? march.high : march_middle(march);
    next.root = march_middle(next);
    next.over = !(next.high - next.low > 2.0f * march.finest);
    return next;
  }
  if (march.waiting > 0.0f) {
    bool samples = march.share < 0.0f;
    bool last = march.points == 1u;
    next.noise = maximum(march.noise, maximum(f.z, 1.0e-30f));
    next.value = f.x;
    next.rise = f.x - march.value;
    float apart = abs(next.rise - march.rise);
    apart = apart >= 0.0f ? apart : 3.0e38f;
    next.stray = samples && march.points + 2u <= MARCH_POINTS ? maximum(march.stray, apart) : 0.0f;
    float share = MARCH_STRAYS * next.stray / next.noise;
    share = share > MARCH_ROUNDS && share < MARCH_LIKELY ? maximum(share, MARCH_LEAST_SHARE) : 1.0f;
    next.share = samples && last ? share : march.share;
    next.points = march.points - 1u;
    next.h = last ? march.waiting : march.h;
    next.waiting = last ? 0.0f : march.waiting;
    return next;
  }

  // If f rounds less than its bound, its e is the piece's curvature and the actual rounding. Where e has shrunk, the rounding is unknown again.
  bool sharp = march.share > 0.0f && march.share < 1.0f;
  bool stale = sharp && !(f.z > 0.5f * march.noise);
  float noise = stale ? 0.0f : march.noise;
  sharp = sharp && !stale;
  float level = sharp ? march.share * noise : noise;
  float e = sharp ? maximum(f.z - noise, 0.0f) + level : f.z;

  // Only where |a + b·s| ≤ e can a root be; and one is, by the signs at both ends, where the line leads from -e to e within the piece.
  float middle = march_middle(march);
  float h = march_half(march);
  bool none = abs(f.x) > abs(f.y) + e;
  bool crosses = abs(f.y) > abs(f.x) + e;
  float centre = -f.x / f.y;
  float width = e / abs(f.y) * BOUND_GROW + 8.0f * EPSILON * (1.0f + abs(centre));
  float left = middle + h * maximum(-1.0f, centre - width);
  float right = middle + h * minimum(1.0f, centre + width);

  // Shorter pieces give no more information. (A NaN is passed over too.)
  bool blunt = march.h <= march.finest || (noise > 0.0f && !(e > MARCH_BLUNT * level));
  bool narrow = crosses && (blunt || right - left <= 16.0f * march.finest);
  bool passes = !none && !narrow && blunt && march.h <= march.pass;

  // Before any is passed over, measure the rounding.
  if (passes && march.share == 0.0f) {
    next.waiting = march.h;
    next.points = MARCH_POINTS;
    next.h = march.finest;
    next.noise = 0.0f;
    next.share = -1.0f;
    return next;
  }
  bool proven = abs(f.x) > abs(f.y) + f.z;

  // The sign where the piece begins: if it is another than before, the root is behind.
  bool known = none || centre - width > -1.0f;
  bool likely = passes && abs(f.x) > minimum(MARCH_LIKELY * f.z, e);
  float sign = f.x < (known ? f.y : 0.0f) ? -1.0f : 1.0f;
  bool changed = (known || likely) && march.sign != 0.0f && sign != march.sign;

  next.sign = known || likely ? sign : march.sign;
  next.found = changed || narrow;
  next.low = march.unknown;
  next.high = known ? march.t : minimum(middle, march.end);
  next.past = changed ? march.t : right;
  next.beyond = changed ? sign : f.y < 0.0f ? -1.0f : 1.0f;
  next.root = changed ? 0.5f * (next.low + next.high) : middle + h * centre;
  next.t = none || passes ? middle + march.h : maximum(march.t, left);
  bool sure = march.unknown == march.t;
  next.unknown = none ? next.t : known ? maximum(march.t, left) : sure && !passes ? next.t : march.unknown;
  next.noise = proven ? 0.0f : march.h <= march.finest ? maximum(noise, maximum(f.z, 1.0e-30f)) : noise;
  next.share = proven || stale ? 0.0f : march.share;
  next.pass = none ? MARCH_FIRST_PASS * march.finest : passes ? 2.0f * march.h : march.pass;
  next.coarse = none || passes ? 3.0e38f : f.z;

  // Next, a piece around the rest, or a longer one. If e hardly shrinks with h, it may be rounding: evaluate a point.
  float closer = minimum(maximum(0.625f * (right - left), crosses ? 0.0f : 0.125f * march.h), 0.5f * march.h);
  bool doubt = !none && !blunt && noise == 0.0f && f.z > 0.7f * march.coarse;
  next.h = none ? 2.0f * march.h
           : passes ? minimum(2.0f * march.h, MARCH_LONGEST_PASS * march.finest)
           : crosses && doubt ? march.h : blunt ? march.pass : closer;
  next.h = minimum(maximum(next.h, march.finest), maximum(0.5f * (march.end - next.t), march.finest));
  next.waiting = doubt ? next.h : 0.0f;
  next.points = doubt ? 1u : 0u;
  next.h = doubt || changed ? march.finest : next.h;
  next.over = next.found ? !changed || !(next.high - next.low > 2.0f * march.finest) : next.t >= march.end;
  bool outside = next.found && !(next.root < march.end);
  next.found = next.found && !outside;
  next.sign = outside ? march.sign : next.sign;
  return next;
}

// From where on the sign is that beyond the root that was found: a little more than march_half behind one within a piece, so that it is not found again.
float march_past(March march) {
  return march.past > march.t ? march.past + 16.0f * (march.finest + EPSILON * abs(march.past)) : march.t;
}

SHADER_END
#endif
