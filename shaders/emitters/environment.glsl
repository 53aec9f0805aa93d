// Light from all around, as a picture has it, and its points, chosen by how bright they are. Between the centres of four texels lies
// a cell, in which the density of the chosen points is the same by solid angle (records.h, Environment).
#ifndef ENVIRONMENT_GLSL
#define ENVIRONMENT_GLSL
#include "math/trigonometry.glsl"
#include "records.h"

SHADER_BEGIN

#if HAS_ENVIRONMENT
// A point in the cell between the columns `column` and the next, and the rows above and below.
struct EnvironmentTexel {
  uint column;
  uint row;
  float right;  // from the cell's left, as a share of it
  float down;
};

EnvironmentTexel texel_towards(Frame frame, vec3 d) {
  float u = 0.5f + atan_yx(d.x, -d.z) * 0.159154943f + frame.environment_turn;
  float x = (u - floor(u)) * float(frame.environment_width) - 0.5f;
  float height = float(frame.environment_height);
  float y = minimum(atan_yx(sqrt(d.x * d.x + d.z * d.z), d.y) * 0.318309886f, 1.0f) * height + 0.5f;
  EnvironmentTexel texel;
  texel.column = x < 0.0f ? frame.environment_width - 1u : uint(x);
  texel.row = uint(y);
  texel.right = x - floor(x);
  texel.down = y - floor(y);
  return texel;
}

uint environment_index(Frame frame, uint column, uint row) { return row * (frame.environment_width + 1u) + column; }

vec3 environment_texel(Frame frame, uint column, uint row) {
  return vec3(bits_to_floats(load_environment(environment_index(frame, column, row))));
}

vec3 environment_radiance(Frame frame, vec3 d) {
  EnvironmentTexel at = texel_towards(frame, d);
  uint above = at.row == 0u ? 0u : at.row - 1u;
  vec3 left = environment_texel(frame, at.column, above);
  vec3 upper = left + (environment_texel(frame, at.column + 1u, above) - left) * at.right;
  left = environment_texel(frame, at.column, at.row);
  vec3 lower = left + (environment_texel(frame, at.column + 1u, at.row) - left) * at.right;
  return upper + (lower - upper) * at.down;
}

// The numbers, of 2^24, that choose a cell of its row, or a row. They begin where those before end.
struct Stretch {
  uint begin;
  uint end;
};

Stretch environment_column(Frame frame, uint column, uint row) {
  Stretch stretch;
  stretch.begin = column == 0u ? 0u : load_environment(environment_index(frame, column - 1u, row)).w;
  stretch.end = load_environment(environment_index(frame, column, row)).w;
  return stretch;
}

Stretch environment_row(Frame frame, uint row) {
  Stretch stretch;
  stretch.begin = row == 0u ? 0u : load_environment(environment_index(frame, frame.environment_width, row - 1u)).w;
  stretch.end = load_environment(environment_index(frame, frame.environment_width, row)).w;
  return stretch;
}

float share_of(Stretch stretch) { return float(stretch.end - stretch.begin) * 5.9604645e-8f; }

// The position of the number u · 2^24 in its stretch, as a share.
float within_stretch(Stretch stretch, float u) {
  return (float(uint(u * 16777216.0f) - stretch.begin) + 0.5f) / float(stretch.end - stretch.begin);
}

// The first of `count` ends, from `first` on by `stride`, that the number u · 2^24 is below.
uint environment_chosen_by(float u, uint first, uint stride, uint count) {
  uint number = uint(u * 16777216.0f);
  uint low = 0u;
  uint high = count - 1u;
  for (uint turn = 0u; turn < 32u; turn++) {
    if (low >= high) break;
    uint middle = (low + high) >> 1u;
    bool before = number >= load_environment(first + middle * stride).w;
    low = before ? middle + 1u : low;
    high = before ? high : middle;
  }
  return low;
}

// Rows are counted from the nearer pole: the distance to it has all its digits.
bool nearer_below(Frame frame, uint row) { return 2u * row > frame.environment_height; }

// The distances of a row's borders from the nearer pole, in rows, the nearer border first.
vec2 environment_borders(Frame frame, uint row) {
  float nearer = float(nearer_below(frame, row) ? frame.environment_height - row : row);
  return vec2(maximum(nearer - 0.5f, 0.0f), minimum(nearer + 0.5f, float(frame.environment_height)));
}

float half_angle_per_row(Frame frame) { return 0.5f * PI / float(frame.environment_height); }

// The density, by solid angle, of directions in that cell.
float environment_cell_density(Frame frame, uint column, uint row) {
  vec2 borders = environment_borders(frame, row);
  // The difference of two cosines, as a product: it does not cancel.
  float height = 2.0f * sine_cosine((borders.x + borders.y) * half_angle_per_row(frame)).x *
                 sine_cosine((borders.y - borders.x) * half_angle_per_row(frame)).x;
  float solid_angle = 2.0f * PI / float(frame.environment_width) * height;
  return share_of(environment_row(frame, row)) * share_of(environment_column(frame, column, row)) / solid_angle;
}

struct EnvironmentSample {
  vec3 direction;
  float density;  // by solid angle
};

EnvironmentSample sample_environment(Frame frame, vec2 u) {
  uint wide = frame.environment_width + 1u;
  uint row = environment_chosen_by(u.y, frame.environment_width, wide, frame.environment_height + 1u);
  uint column = environment_chosen_by(u.x, row * wide, 1u, frame.environment_width);
  float right = within_stretch(environment_column(frame, column, row), u.x);
  float down = within_stretch(environment_row(frame, row), u.y);

  // The height is even between the row's borders.
  bool below = nearer_below(frame, row);
  vec2 borders = environment_borders(frame, row);
  float nearer = sine_cosine(borders.x * half_angle_per_row(frame)).x;
  float farther = sine_cosine(borders.y * half_angle_per_row(frame)).x;
  float left = 2.0f * (nearer * nearer + (farther * farther - nearer * nearer) * (below ? 1.0f - down : down));
  float across = sqrt(maximum(left * (2.0f - left), 0.0f));
  vec2 turned = sine_cosine(2.0f * PI * ((float(column) + 0.5f + right) / float(frame.environment_width) - 0.5f - frame.environment_turn));
  EnvironmentSample chosen;
  chosen.direction = vec3(turned.x * across, below ? left - 1.0f : 1.0f - left, -turned.y * across);
  chosen.density = environment_cell_density(frame, column, row);
  return chosen;
}

float environment_density(Frame frame, vec3 d) {
  EnvironmentTexel at = texel_towards(frame, d);
  return environment_cell_density(frame, at.column, at.row);
}
#endif

// The probability of choosing the environment, and not a light.
float environment_share(Frame frame) {
#if HAS_ENVIRONMENT
  return float(frame.environment_numbers) * 5.9604645e-8f;
#else
  return 0.0f;
#endif
}

// The light seen by a ray that hits nothing.
vec3 surroundings(Frame frame, vec3 d) {
  vec3 light = frame.background;
#if HAS_ENVIRONMENT
  if (frame.environment_width > 0u) light = environment_radiance(frame, d);
#endif
  return light;
}

SHADER_END
#endif
