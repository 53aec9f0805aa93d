// A picture known in closed form at every point, to try the comparisons on. It is an ideal reference
// picture, with one discontinuity of each kind. All edges lie 0.00003 pixels beyond a row or column of pixel
// centres, so that rays moved by 0.00005 pixels cross them: a small honest difference, like those of float32.
#pragma once

#include <cmath>

#include "host/compare/explain.hpp"

namespace eyeray::engine::test {

inline constexpr int picture_width = 96;
inline constexpr int picture_height = 72;
inline constexpr double beyond = 3e-5;
// Pixels along each of the four edges.
inline constexpr int edge_pixels = 8;

// The hit of a ray along −z with primitive `number`, whose material has the same number.
inline FirstHit hit_of(double t, const Vec3& position, const Vec3& normal, const Vec2& uv, int32_t number) {
  return {.t = t,
          .position = position,
          .normal = normal,
          .normal_geometric = normal,
          .cosine = normal.z,
          .uv = uv,
          .primitive = number,
          .material = number};
}

// The picture at a point in pixels from its top left corner: a ball (primitive 1) before a wall (primitive
// 0), an opening in the wall, a shadow and a checker's edge on it. There is also a mirror (primitive 2),
// which shows two adjacent colours.
inline compare::Neighbour picture_at(double x, double y) {
  const auto between = [](double value, double low, double high) { return value >= low && value < high; };
  compare::Neighbour neighbour;
  compare::Neighbour::Sample& sample = neighbour.samples.front();
  sample.counts = {1, 2};

  // The wall, lit a little unevenly.
  sample.color = Vec3(0.5, 0.4, 0.3) * (1 + 0.1 * std::sin(x / 20) * std::cos(y / 20));
  neighbour.first_hit = hit_of(1000, {x, -y, 0}, {0, 0, 1}, {x, y}, 0);

  // The ball.
  const double radius = 25, dx = x - 48, dy = y - 34, r2 = dx * dx + dy * dy;
  if (r2 < radius * radius) {
    const double z = std::sqrt(radius * radius - r2);
    const Vec3 n = Vec3(dx, -dy, z) / radius;
    const double light = std::max(0.0, glm::dot(n, glm::normalize(Vec3(1, 2, 3))));
    sample.color = Vec3(0.1) + light * Vec3(0.9, 0.5, 0.2);
    neighbour.first_hit = hit_of(900 - z, {x, -y, z}, n, {n.x, n.y}, 1);
  }
  // The opening, through which nothing is hit.
  if (between(x, 88.5 + beyond, 96) && between(y, 4, 4 + edge_pixels)) {
    sample = {.color = Vec3(0.1, 0.2, 0.9), .counts = {0, 1}};
    neighbour.first_hit = {};
  }
  // The shadow.
  if (between(y, 60.5 + beyond, 65) && between(x, 4, 4 + edge_pixels)) sample.color *= 0.4;
  // The checker.
  if (between(x, 20.5 + beyond, 24) && between(y, 60, 60 + edge_pixels)) {
    sample.color *= Vec3(0.2, 0.9, 0.2);
    neighbour.first_colors = 1;
  }
  // The mirror.
  if (between(x, 4, 4 + edge_pixels) && between(y, 4, 16)) {
    sample.color = y < 10.5 + beyond ? Vec3(0.8, 0.1, 0.1) : Vec3(0.1, 0.1, 0.8);
    neighbour.first_hit = hit_of(800, {x, -y, 5}, {0, 0.6, 0.8}, {x, y}, 2);
    sample.counts = {2, 4};
    neighbour.direct = false;
  }
  neighbour.first_surfaces = uint64_t(neighbour.first_hit.primitive);
  return neighbour;
}

inline compare::Neighbour picture_reference(int x, int y, const Vec2& shift,
                                            rounding::Coincidence = rounding::Coincidence::none) {
  return picture_at(x + 0.5 + shift.x, y + 0.5 + shift.y);
}

// The picture as an executor would return it, with rays moved by `shift`.
inline compare::Frame picture_frame(const Vec2& shift = Vec2(0.0),
                                    const compare::Reference& picture = picture_reference) {
  compare::Frame frame;
  frame.area = {0, 0, picture_width, picture_height};
  frame.color = image::Image(picture_width, picture_height, 3);
  frame.hits = frame.rays_traced = image::Image(picture_width, picture_height, 1);
  frame.rays = 2u * picture_width * picture_height;
  for (int y = 0; y < picture_height; ++y) {
    for (int x = 0; x < picture_width; ++x) {
      const compare::Neighbour neighbour = picture(x, y, shift, rounding::Coincidence::none);
      const compare::Neighbour::Sample& sample = neighbour.samples.front();
      for (int c = 0; c < 3; ++c) frame.color.pixel(x, y)[c] = float(sample.color[c]);
      *frame.hits.pixel(x, y) = float(sample.counts.x);
      *frame.rays_traced.pixel(x, y) = float(sample.counts.y);
      frame.first_hits.push_back(neighbour.first_hit);
    }
  }
  return frame;
}

}  // namespace eyeray::engine::test
