#include "host/reference/emitter_sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "host/reference/spherical_area.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::reference {

namespace {

// True if the point is outside of the sphere enlarged a little. So a point on the sphere counts as inside.
bool outside(const SphereForm& sphere, const Vec3& from) {
  const Vec3 way = sphere.center - from;
  return glm::dot(way, way) > 1.0002 * sphere.radius * sphere.radius;
}

// The density, by solid angle, of a point that is chosen evenly on an area.
double density_of_area(double area, const Vec3& from, const EmitterSample& point) {
  const Vec3 way = point.position - from;
  const double distance = glm::length(way);
  return distance * distance * distance / (area * std::abs(glm::dot(way, point.normal)));
}

// 1 − the cosine of half the angle under which the sphere is seen.
double versine(const SphereForm& sphere, const Vec3& from) {
  const double sine = sphere.radius / glm::length(sphere.center - from);
  return 1 - std::sqrt((1 - sine) * (1 + sine));
}

// Longitude and latitude of a direction.
Vec2 globe(const Vec3& n) {
  const double u = 0.5 + std::atan2(-n.z, n.x) / (2 * M_PI);
  return {u < 1 ? u : 0, std::atan2(std::hypot(n.x, n.z), -n.y) / M_PI};
}

// A point on the sphere as `from` sees it. Wang: Physically Correct Direct Lighting for Distribution Ray
// Tracing, Graphics Gems III, 1992.
EmitterSample on_sphere(const SphereForm& sphere, const Vec3& from, const Vec2& u) {
  const double turn = 2 * M_PI * u.y;
  const bool seen = outside(sphere, from);
  const Vec3 way = sphere.center - from;
  const Vec3 axis = seen ? glm::normalize(way) : Vec3(0, 0, 1);
  const double cosine = 1 - (seen ? u.x * versine(sphere, from) : 2 * u.x);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const auto [s, t] = tangents(axis);
  const Vec3 d = cosine * axis + sine * (std::cos(turn) * s + std::sin(turn) * t);
  Vec3 normal = d;
  if (seen) {
    const double b = glm::dot(way, d);
    const double c = glm::dot(way, way) - sphere.radius * sphere.radius;
    const double near = b - std::sqrt(std::max(0.0, b * b - c));
    // If `from` is so far away that rounding loses the radius, take the nearest point of the sphere.
    const Vec3 out = near * d - way;
    normal = glm::length(out) > 0 ? glm::normalize(out) : -d;
  }
  return {sphere.center + sphere.radius * normal, normal, globe(glm::transpose(sphere.axes) * normal)};
}

// One face of a box. In arrays of faces the two faces across the box's x axis come first.
struct Face {
  Vec3 center, half_u, half_v, normal;  // outward
  double weight;                        // the probability of the face is proportional to it
  int axis, sign;

  double area() const { return 4 * glm::length(glm::cross(half_u, half_v)); }
};

// The faces and their weights. From outside, the weight of a face turned to the point is area · cosine /
// distance² of its centre; other faces have the weight 0. From inside, the weight is the area.
std::array<Face, 6> faces(const BoxForm& box, const Vec3& from, bool& outside) {
  const Mat3 m(box.to_world);
  std::array<Face, 6> all;
  outside = false;
  for (int i = 0; i < 6; ++i) {
    const int axis = i / 2, sign = i % 2 ? 1 : -1;
    Face& face = all[size_t(i)];
    face = {Vec3(box.to_world[3]) + double(sign) * m[axis],
            m[(axis + 1) % 3],
            m[(axis + 2) % 3],
            {},
            0,
            axis,
            sign};
    const Vec3 across = glm::normalize(glm::cross(face.half_u, face.half_v));
    face.normal = glm::dot(across, m[axis]) * sign > 0 ? across : -across;
    const Vec3 way = from - face.center;
    // The box is enlarged a little, so that a point on it does not count as outside.
    const double height = glm::dot(way, face.normal) - 0.0002 * std::abs(glm::dot(m[axis], face.normal));
    face.weight = face.area() * height / std::pow(glm::length(way), 3);
    outside = outside || face.weight > 0;
  }
  for (Face& face : all) face.weight = outside ? std::max(0.0, face.weight) : face.area();
  return all;
}

EmitterSample on_box(const BoxForm& box, const Vec3& from, const Vec2& u) {
  bool outside;
  const auto all = faces(box, from, outside);
  double sum = 0;
  for (const Face& face : all) sum += face.weight;
  double rest = u.x * sum;
  size_t i = 0;
  while (i < 5 && !(rest < all[i].weight)) rest -= all[i++].weight;
  const Face& face = all[i];
  // The random numbers choose the position along the two other axes, in the order of the axes.
  Vec3 p(0);
  p[face.axis] = face.sign;
  p[face.axis == 0 ? 1 : 0] = 2 * rest / face.weight - 1;
  p[face.axis == 2 ? 1 : 2] = 2 * u.y - 1;
  // Seen from outside, u runs to the right and v upwards. Upwards is −z on the top face, and +z on the bottom
  // face.
  Vec2 uv(p.x * face.sign, p.y);
  if (face.axis == 0) uv = {-p.z * face.sign, p.y};
  if (face.axis == 1) uv = {p.x, -p.z * face.sign};
  return {Vec3(box.to_world * Vec4(p, 1)), face.normal, inner_uv(0.5 + 0.5 * uv)};
}

double box_density(const BoxForm& box, const Vec3& from, const EmitterSample& point) {
  bool outside;
  const auto all = faces(box, from, outside);
  double sum = 0, nearest = 0;
  const Face* of_point = nullptr;
  for (const Face& face : all) {
    sum += face.weight;
    // The normal may be turned to either side.
    const double cosine = glm::dot(face.normal, point.normal);
    const double same =
        glm::dot(point.position - Vec3(box.to_world[3]), face.normal) > 0 ? std::abs(cosine) : 0;
    if (same > nearest) {
      nearest = same;
      of_point = &face;
    }
  }
  if (!of_point) return 0;
  return of_point->weight / sum * density_of_area(of_point->area(), from, point);
}

// Samples a point of the unit sphere in the ellipsoid's own space, and maps it to the world.
EmitterSample on_ellipsoid(const EllipsoidForm& it, const Vec3& from, const Vec2& u) {
  const Affine map(it.to_world), back(glm::inverse(it.to_world));
  const EmitterSample own = on_sphere({Vec3(0), 1}, back.point(from), u);
  return {map.point(own.position), map.normal(own.normal), globe(own.normal)};
}

double ellipsoid_density(const EllipsoidForm& it, const Vec3& from, const EmitterSample& point) {
  const Affine map(it.to_world), back(glm::inverse(it.to_world));
  const SphereForm own{Vec3(0), 1};
  const double determinant = std::abs(glm::determinant(back.linear));
  if (outside(own, back.point(from))) {
    // The density by solid angle in the ellipsoid's own space, mapped to the world.
    const double stretch = glm::length(back.linear * glm::normalize(point.position - from));
    return determinant / std::pow(stretch, 3) / (2 * M_PI * versine(own, back.point(from)));
  }
  // The ratio of an area in the world to that in the ellipsoid's own space.
  const Vec3 normal = glm::normalize(glm::transpose(map.linear) * point.normal);
  const double stretch = glm::length(map.cotangent * normal) / determinant;
  return density_of_area(4 * M_PI * stretch, from, point);
}

EmitterSample on_cylinder(const CylinderForm& it, const Vec2& u) {
  const Affine map(it.to_world);
  const double side = share_of_side(it);
  if (u.x < side) {
    const double turn = 2 * M_PI * (u.x / side);
    const Vec3 out(std::cos(turn), 0, std::sin(turn));
    return {map.point(out + Vec3(0, 2 * u.y - 1, 0)), map.normal(out), {globe(out).x, u.y}};
  }
  double rest = 2 * (u.x - side) / (1 - side);
  const double up = rest < 1 ? -1 : 1;
  if (up > 0) rest -= 1;
  const Vec2 at = on_disk({rest, u.y});
  return {map.point({at.x, up, at.y}), map.normal({0, up, 0}), {0.5 + 0.5 * at.x, 0.5 - 0.5 * at.y * up}};
}

double cylinder_density(const CylinderForm& it, const Vec3& from, const EmitterSample& point) {
  const Mat3 m(it.to_world);
  const double side = share_of_side(it);
  const Vec3 own = glm::normalize(glm::transpose(m) * point.normal);
  if (std::abs(own.y) > 0.7)
    return (1 - side) / 2 * density_of_area(M_PI * glm::length(glm::cross(m[0], m[2])), from, point);
  const Vec3 along = m * glm::normalize(Vec3(-own.z, 0, own.x));
  return side * density_of_area(4 * M_PI * glm::length(glm::cross(along, m[1])), from, point);
}

// True if points are chosen by solid angle, and not by area.
bool by_solid_angle(double solid_angle, double least = 3e-4) {
  return solid_angle >= least && solid_angle <= 6.22;
}
constexpr double least_rectangle = 0.01;

SphericalTriangle seen_from(const Vec3& from, const TriangleForm& it) {
  return SphericalTriangle({it.vertices[0] - from, it.vertices[1] - from, it.vertices[2] - from});
}

// The point where the direction hits the triangle's plane, as weights of the second and the third corner.
Vec2 weights_along(const Vec3& d, const Vec3& from, const TriangleForm& it) {
  const auto& [a, b, c] = it.vertices;
  const Vec3 n = glm::cross(b - a, c - a);
  const Vec3 p = d * (glm::dot(n, a - from) / glm::dot(n, d)) - (a - from);
  const double squared = glm::dot(n, n);
  return {glm::dot(n, glm::cross(p, c - a)) / squared, glm::dot(n, glm::cross(b - a, p)) / squared};
}

EmitterSample on_triangle(const TriangleForm& it, const Vec3& from, const Vec2& u) {
  const auto& [a, b, c] = it.vertices;
  const SphericalTriangle seen = seen_from(from, it);
  const double root = std::sqrt(u.x);
  Vec2 weights(root * (1 - u.y), root * u.y);
  if (by_solid_angle(seen.solid_angle())) weights = weights_along(seen.direction(u), from, it);
  return {a + weights.x * (b - a) + weights.y * (c - a), glm::normalize(glm::cross(b - a, c - a)), weights};
}

// The two triangles on either side of a diagonal.
std::array<TriangleForm, 2> halves(const ParallelogramForm& it) {
  const Vec3 &a = it.corner, b = a + it.edge_u, c = b + it.edge_v, d = a + it.edge_v;
  return {TriangleForm{{a, b, c}}, TriangleForm{{a, c, d}}};
}

// Samples a parallelogram without right angles by solid angle, around its first corner.
Vec2 position_around_corner(const ParallelogramForm& it, const Vec3& from, const Vec2& u) {
  const auto [low, high] = halves(it);
  const double first = seen_from(from, low).solid_angle(), second = seen_from(from, high).solid_angle();
  if (!by_solid_angle(first + second)) return u;
  const double turn = u.y * (first + second);
  if (turn < first) {
    const Vec2 weights = weights_along(seen_from(from, low).direction({u.x, turn / first}), from, low);
    return {weights.x + weights.y, weights.y};
  }
  const Vec2 weights =
      weights_along(seen_from(from, high).direction({u.x, (turn - first) / second}), from, high);
  return {weights.x, weights.x + weights.y};
}

EmitterSample on_parallelogram(const ParallelogramForm& it, const Vec3& from, const Vec2& u) {
  Vec2 at = u;
  if (is_rectangle(it)) {
    const SphericalRectangle seen(it.corner - from, it.edge_u, it.edge_v);
    if (by_solid_angle(seen.solid_angle(), least_rectangle)) at = seen.position(u);
  } else {
    at = position_around_corner(it, from, u);
  }
  return {it.corner + at.x * it.edge_u + at.y * it.edge_v, glm::normalize(glm::cross(it.edge_u, it.edge_v)),
          at};
}

// The solid angle under which the form is seen; empty if points on it are not chosen by solid angle.
std::optional<double> sampled_solid_angle(const EmitterForm& form, const Vec3& from) {
  double solid_angle = 0;
  if (const auto* triangle = std::get_if<TriangleForm>(&form))
    solid_angle = seen_from(from, *triangle).solid_angle();
  if (const auto* it = std::get_if<ParallelogramForm>(&form)) {
    if (is_rectangle(*it)) {
      solid_angle = SphericalRectangle(it->corner - from, it->edge_u, it->edge_v).solid_angle();
      return by_solid_angle(solid_angle, least_rectangle) ? std::optional(solid_angle) : std::nullopt;
    }
    for (const TriangleForm& half : halves(*it)) solid_angle += seen_from(from, half).solid_angle();
  }
  return by_solid_angle(solid_angle) ? std::optional(solid_angle) : std::nullopt;
}

struct Chooser {
  const Vec3& from;
  const Vec2& u;

  EmitterSample operator()(const SphereForm& sphere) const { return on_sphere(sphere, from, u); }

  EmitterSample operator()(const DiskForm& disk) const {
    const Vec3 x(disk.to_world[0]), z(disk.to_world[2]);
    const Vec2 at = on_disk(u);
    const double r = glm::length(at);
    const double hole = disk.inner * disk.inner;
    const double grow = r == 0 ? 1 : std::sqrt(hole + r * r * (1 - hole)) / r;
    return {Vec3(disk.to_world[3]) + grow * (at.x * x + at.y * z),
            glm::normalize(glm::cross(x, z)),
            {0.5 + 0.5 * grow * at.x, 0.5 - 0.5 * grow * at.y}};
  }

  EmitterSample operator()(const TriangleForm& it) const { return on_triangle(it, from, u); }
  EmitterSample operator()(const ParallelogramForm& it) const { return on_parallelogram(it, from, u); }
  EmitterSample operator()(const BoxForm& box) const { return on_box(box, from, u); }
  EmitterSample operator()(const EllipsoidForm& ellipsoid) const { return on_ellipsoid(ellipsoid, from, u); }
  EmitterSample operator()(const CylinderForm& cylinder) const { return on_cylinder(cylinder, u); }
};

}  // namespace

EmitterSample sample_emitter(const EmitterForm& form, const Vec3& from, const Vec2& u) {
  return std::visit(Chooser{from, u}, form);
}

double emitter_density(const EmitterForm& form, const Vec3& from, const EmitterSample& point) {
  if (const auto* sphere = std::get_if<SphereForm>(&form); sphere && outside(*sphere, from))
    return 1 / (2 * M_PI * versine(*sphere, from));
  if (const auto* box = std::get_if<BoxForm>(&form)) return box_density(*box, from, point);
  if (const auto* it = std::get_if<EllipsoidForm>(&form)) return ellipsoid_density(*it, from, point);
  if (const auto* it = std::get_if<CylinderForm>(&form)) return cylinder_density(*it, from, point);
  if (const auto solid_angle = sampled_solid_angle(form, from)) return 1 / *solid_angle;
  return density_of_area(area_of(form), from, point);
}

Vec3 emitter_radiance(const Scene& scene, const Emitter& emitter, const EmitterSample& point,
                      const Vec3& from) {
  if (emitter.side * glm::dot(point.normal, from - point.position) < 0) return Vec3(0);
  if (!emitter.varies) return emitter.radiance;
  TextureContext at(point.uv, point.position);
  Vec3 color(1);
  if (const EmitterCorners* corners = emitter.corners.get()) {
    const auto between = [&](const auto& values) {
      return (1 - point.uv.x - point.uv.y) * values[0] + point.uv.x * values[1] + point.uv.y * values[2];
    };
    at.uv = between(corners->uv);
    at.second_uv = between(corners->second_uv);
    color = between(corners->colors);
  }
  return emitted(*scene.materials[size_t(emitter.material)], at, color);
}

Vec2 on_disk(const Vec2& u) {
  const Vec2 square = 2.0 * u - 1.0;
  if (square == Vec2(0)) return Vec2(0);
  const bool wide = std::abs(square.x) > std::abs(square.y);
  const double radius = wide ? square.x : square.y;
  const double angle = wide ? M_PI / 4 * square.y / square.x : M_PI / 2 - M_PI / 4 * square.x / square.y;
  return radius * Vec2(std::cos(angle), std::sin(angle));
}

std::pair<Vec3, Vec3> tangents(const Vec3& n) {
  // An axis that belongs to no symmetry of a sensible scene.
  const Vec3 axis = glm::normalize(Vec3(0.3141592653589793, 0.8979323846264338, 0.2718281828459045));
  const Vec3 s = glm::normalize(glm::cross(axis, n));
  return {s, glm::cross(n, s)};
}

}  // namespace eyeray::engine::reference
