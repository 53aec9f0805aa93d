#include "host/shapes/object_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/records/packer.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

// The largest sum of a row of |linear| · |inverse|, the product of the matrices of absolute values.
double growth(const Affine& map, const Affine& inverse) {
  double largest = 0;
  for (int row = 0; row < 3; ++row) {
    double sum = 0;
    for (int column = 0; column < 3; ++column)
      for (int k = 0; k < 3; ++k) sum += std::fabs(map.linear[k][row] * inverse.linear[column][k]);
    largest = std::max(largest, sum);
  }
  return largest;
}

}  // namespace

ObjectShape::ObjectShape(uint32_t kind, const Mat4& to_world, const std::vector<float>& parameters,
                         size_t steps)
    : kind_(kind),
      to_world_(to_world),
      to_object_(glm::inverse(to_world)),
      parameters_(parameters),
      steps_(steps) {}

std::optional<Intersection> ObjectShape::intersect(const Ray& ray) const {
  const auto& [local, start] = to_nearest(ray);
  std::optional<Intersection> nearest = first(local, -start);
  if (nearest) nearest->t += start;
  return nearest && (nearest->t > 0 || nearest->iteration_limit) ? nearest : std::nullopt;
}

std::optional<Intersection> ObjectShape::first(const Ray& ray, double from) const {
  std::optional<Intersection> nearest;
  for (const Intersection& crossing : crossings(ray))
    if (crossing.t > from && std::isfinite(crossing.t) && (!nearest || crossing.t < nearest->t))
      nearest = crossing;
  return nearest;
}

bool ObjectShape::enters(const Ray& ray, const Intersection& crossing) const {
  return glm::dot(point(ray.o + ray.d * crossing.t, crossing).gradient, ray.d) < 0;
}

std::pair<Ray, double> ObjectShape::to_nearest(const Ray& ray) const {
  const Vec3 o = to_object_.point(ray.o);
  const Vec3 d = to_object_.linear * ray.d;
  const double start = -glm::dot(o, d) / glm::dot(d, d);
  return {{o + d * start, d}, start};
}

std::vector<Span> ObjectShape::spans(const Ray& ray) const {
  const auto& [local, start] = to_nearest(ray);
  struct Passage {
    Intersection at;
    bool enters;
  };
  std::vector<Passage> passages;
  for (Intersection crossing : crossings(local)) {
    const bool comes_in = enters(local, crossing);
    crossing.t += start;
    if (std::isfinite(crossing.t)) passages.push_back({crossing, comes_in});
  }
  std::ranges::stable_sort(passages, {}, [](const Passage& passage) { return passage.at.t; });

  // At an edge, rounding may let a ray enter by two faces, or leave by two: count one entry and one exit.
  std::vector<Span> spans;
  std::optional<Intersection> entered;
  for (const Passage& passage : passages) {
    if (passage.enters) {
      if (!entered) entered = passage.at;
    } else if (entered) {
      if (entered->t < passage.at.t) spans.push_back({*entered, passage.at});
      entered.reset();
    }
  }
  return spans;
}

SurfacePoint ObjectShape::surface(const Ray& ray, const Intersection& hit) const {
  const Point local = point(to_object_.point(ray.o + ray.d * hit.t), hit);
  const Mat3& linear = to_world_.linear;
  const Vec3 size = glm::abs(local.position);
  SurfacePoint surface;
  surface.position = to_world_.point(local.position);
  surface.position_error = 1e-13 * (magnitude(linear[0]) * size.x + magnitude(linear[1]) * size.y +
                                    magnitude(linear[2]) * size.z + magnitude(to_world_.offset));
  surface.normal_geometric = to_world_.normal(local.gradient);
  surface.normal = surface.normal_geometric;
  surface.uv = local.uv;
  surface.along_u = linear * local.along_u;
  surface.along_v = linear * local.along_v;
  return surface;
}

Bounds ObjectShape::bounds() const {
  const Bounds box = extent();
  Bounds bounds;
  for (int corner = 0; corner < 8; ++corner)
    bounds.include(to_world_.point({corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                    corner & 4 ? box.max.z : box.min.z}));
  return bounds;
}

void ObjectShape::pack(records::Packer& packer) const {
  pack_with(packer, parameters_);
}

void ObjectShape::pack_with(records::Packer& packer, const std::vector<float>& parameters) const {
  packer.add(record_with(packer, material, parameters));
}

shader::Primitive ObjectShape::record(records::Packer& packer, int of_material) const {
  return record_with(packer, of_material, parameters_);
}

shader::Primitive ObjectShape::record_with(records::Packer& packer, int of_material,
                                           const std::vector<float>& parameters) const {
  const auto row = [](const Affine& map, int i, const Vec3& offset) {
    return records::to_vec4({map.linear[0][i], map.linear[1][i], map.linear[2][i]}, offset[i]);
  };
  const Vec3 center = packer.relative(to_world_.offset);
  const uint32_t extra = packer.add_vertices({records::to_bits(row(to_world_, 0, center)),
                                              records::to_bits(row(to_world_, 1, center)),
                                              records::to_bits(row(to_world_, 2, center))});
  for (size_t i = 0; i < parameters.size(); i += 4) {
    shader::vec4 some(0);
    for (size_t k = 0; k < 4 && i + k < parameters.size(); ++k) some[int(k)] = parameters[i + k];
    packer.add_vertices({records::to_bits(some)});
  }
  packer.add_iterations(steps_);
  if (steps_ > 0) packer.add_iteration_limit();
  packer.add_map_growth(growth(to_world_, to_object_));
  return records::Packer::primitive(kind_, of_material, row(to_object_, 0, center),
                                    row(to_object_, 1, center), row(to_object_, 2, center), extra);
}

Mat4 along_axis(const Vec3& from, const Vec3& to, double radius, double low, double high) {
  const Vec3 y = unit(to - from);
  const Vec3 reference = std::fabs(y.x) < 0.99 ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
  const Vec3 x = unit(reference - y * glm::dot(reference, y));
  const Vec3 z = glm::cross(x, y);
  const Vec3 step = (to - from) / (high - low);
  return {{x * radius, 0}, {step, 0}, {z * radius, 0}, {from - step * low, 1}};
}

std::string why_out_of_range(const Mat4& to_world) {
  bool fits = magnitude(Vec3(to_world[3])) <= max_coordinate;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = magnitude(Vec3(to_world[axis]));
    fits = fits && size >= min_radius && size <= max_coordinate;
  }
  if (!fits) return "the shape is out of range (sizes 1e-12 to 1e12, coordinates up to 1e12)";
  const std::string why = why_singular(to_world);
  return why.empty()
             ? why
             : fmt::format("the shape is too thin for its size: as the transform of a unit shape, {}", why);
}

bool out_of_range(TableReader& table, const Mat4& to_world) {
  const std::string why = why_out_of_range(to_world);
  if (!why.empty()) table.error("transform", why);
  return !why.empty();
}

Vec3 along_turn(const Vec3& p) {
  return 2 * M_PI * Vec3(p.z, 0, -p.x);
}

Vec3 along_meridian(const Vec3& n) {
  const double from_axis = std::hypot(n.x, n.z);
  const Vec2 outward = from_axis > 0 ? Vec2(n.x, n.z) / from_axis : Vec2(1, 0);
  return M_PI * Vec3(-n.y * outward.x, from_axis, -n.y * outward.y);
}

std::vector<double> quadratic_roots(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0)) return {};
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  std::vector<double> roots;
  if (a != 0) roots.push_back(q / a);
  if (q != 0) roots.push_back(c / q);
  return roots;
}

}  // namespace eyeray::engine::shapes
