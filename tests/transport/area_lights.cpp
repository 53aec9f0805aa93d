// Area lights of each shape that paths sample, with known results.
#include <functional>

#include "patch.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// Irradiance at the floor's origin from a convex body of radiance 1 above the floor: the sum over the facets
// that face the origin. `at(u, v)` is a point of the body's surface, which u and v in [0, 1] cover.
double irradiance_of_body(const std::function<Vec3(double, double)>& at, const Vec3& middle) {
  constexpr int steps = 400;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int k = 0; k < steps; ++k) {
      const auto corner = [&](int x, int y) { return at(double(i + x) / steps, double(k + y) / steps); };
      const Vec3 a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
      Vec3 normal = glm::cross(c - a, d - b);
      if (glm::length(normal) == 0) continue;
      if (glm::dot(normal, a - middle) < 0) normal = -normal;
      if (glm::dot(normal, a) >= 0) continue;
      for (const auto& corners : {std::vector{a, b, c}, std::vector{a, c, d}})
        if (glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0])) > 1e-14)
          sum += irradiance_of(corners);
    }
  return sum;
}

Mat4 turned() {
  return glm::rotate(glm::translate(Mat4(1.0), Vec3(0.4, 1.4, -0.3)), 0.7, glm::normalize(Vec3(1, 2, 3)));
}

}  // namespace

TEST_CASE("a box above the floor lights it with the irradiance of its faces") {
  const Vec3 size(0.4, 0.2, 0.3);
  Scene scene = floor(1024);
  add(scene, make_box(-size, size, turned()), emissive(scene));
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      std::vector<Vec3> corners;
      for (const auto& [u, v] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
        Vec3 p;
        p[axis] = side * size[axis];
        p[(axis + 1) % 3] = u * size[(axis + 1) % 3];
        p[(axis + 2) % 3] = v * size[(axis + 2) % 3];
        corners.push_back(Vec3(turned() * Vec4(p, 1)));
      }
      Vec3 normal(0);
      normal[axis] = side;
      if (glm::dot(Mat3(turned()) * normal, corners[0]) < 0) sum += irradiance_of(corners);
    }
  check(scene, shown(sum));
}

TEST_CASE("an ellipsoid and a sheared ellipsoid light the floor below by their closed forms") {
  Mat4 shear(1.0);
  shear[1].x = 0.5;
  for (const Mat4& map : {turned(), turned() * shear}) {
    const Vec3 radii(0.5, 0.2, 0.35);
    Scene scene = floor();
    add(scene, make_ellipsoid(Vec3(0), radii, map), emissive(scene));
    const double expected = irradiance_of_body(
        [&](double u, double v) {
          const double across = std::sin(M_PI * v);
          return Vec3(map * Vec4(radii * Vec3(across * std::cos(2 * M_PI * u), std::cos(M_PI * v),
                                              across * std::sin(2 * M_PI * u)),
                                 1));
        },
        Vec3(map[3]));
    check(scene, shown(expected), 2e-4);
  }
}

TEST_CASE("a cylinder and an upright tube light the floor below by their closed forms") {
  Mat4 shear(1.0);
  shear[1].x = 0.5;
  for (const Mat4& map : {turned(), turned() * shear}) {
    Scene scene = floor(1024);
    add(scene, make_cylinder({0, -0.3, 0}, {0, 0.3, 0}, 0.25, false, map), emissive(scene));
    const auto point = [&](double radius, double turn, double y) {
      return Vec3(map * Vec4(radius * std::cos(2 * M_PI * turn), y, radius * std::sin(2 * M_PI * turn), 1));
    };
    // As v grows, the point goes from the axis along the bottom, up the side, and along the top back to the
    // axis.
    const double expected = irradiance_of_body(
        [&](double u, double v) {
          if (v < 0.25) return point(v, u, -0.3);
          if (v > 0.75) return point(1 - v, u, 0.3);
          return point(0.25, u, -0.3 + 1.2 * (v - 0.25));
        },
        Vec3(map[3]));
    check(scene, shown(expected), 2e-4);
  }
  // The surroundings above are visible through the tube. The tube's own light is that of an equally wide disk
  // at its foot, less that of such a disk at its head.
  Scene tube = floor(1024);
  add(tube, make_cylinder({0, 1, 0}, {0, 3, 0}, 0.5, true), emissive(tube));
  check(tube, shown(M_PI * (0.25 / 1.25 - 0.25 / 9.25)));
}

TEST_CASE("inside an emitting body the radiance is L / (1 − ρ), by shadow rays or by chance") {
  const auto inside = [](const std::function<std::unique_ptr<Shape>()>& body) {
    for (const bool sampled : {true, false}) {
      Scene scene = patch({0.1, 0.2, 0.15}, {0.1, -0.3, -0.4}, 256);
      scene.render.max_depth = 64;
      const int material = add(scene, make_phong({.diffuse = gray(0.6), .emission = gray(1)}));
      scene.materials[size_t(material)]->samples_emission = sampled;
      add(scene, body(), material);
      check(scene, 1 / (1 - 0.6), 1e-4);
    }
  };
  inside([] { return make_box({-0.5, -0.5, -0.5}, {0.5, 0.7, 0.6}); });
  inside([] { return make_ellipsoid({0, 0, 0}, {0.8, 0.6, 0.7}); });
  inside([] { return make_cylinder({0, -0.5, 0}, {0, 0.6, 0}, 0.7); });
}

TEST_CASE("a one-sided area light shines in front, and is dark from behind") {
  const Vec3 a(-0.5, 0.6, 0.2), u(1.2, 0.5, 0.2), v(0.6, 0.3, 1);
  const double of_both = irradiance_of({a, a + u, a + u + v, a + v}),
               of_triangle = irradiance_of({a, a + u, a + v});
  const auto lit = [&](std::unique_ptr<Shape> shape, double expected) {
    Scene scene = floor();
    const int front = emissive(scene);
    scene.materials[size_t(front)]->emits_in_front = true;
    add(scene, std::move(shape), front);
    check(scene, shown(expected));
  };
  Mat4 mirror(1.0);
  mirror[2].z = -1;
  const auto mirrored = [](const Vec3& p) { return Vec3(p.x, p.y, -p.z); };
  CHECK(glm::dot(glm::cross(u, v), a) < 0);  // u × v points to the origin
  lit(make_parallelogram(a, u, v), of_both);
  lit(make_parallelogram(a, v, u), 0);
  lit(make_triangle({.vertices = {a, a + u, a + v}}), of_triangle);
  lit(make_triangle({.vertices = {a, a + v, a + u}}), 0);
  lit(make_triangle({.vertices = {mirrored(a), mirrored(a + v), mirrored(a + u)}}, mirror), of_triangle);
  const double of_disk = M_PI * 0.64 / (0.64 + 1.69);
  lit(make_disk({0, 1.3, 0}, {0, -1, 0}, 0.8), of_disk);
  lit(make_disk({0, 1.3, 0}, {0, 1, 0}, 0.8), 0);
  lit(make_disk({0, -1.3, 0}, {0, 1, 0}, 0.8, 0, glm::rotate(Mat4(1.0), M_PI, Vec3(1, 0, 0))), of_disk);
  lit(make_sphere({0, 1.6, 1.2}, 0.7), M_PI * 0.7 * 0.7 * 0.8 / 4);

  // The mesh as it is, and mirrored.
  for (const Mat4& map : {Mat4(1.0), mirror})
    for (const bool away : {false, true}) {
      Scene scene = floor();
      scene.meshes.push_back(
          {.name = "", .positions = {a, a + u, a + v}, .triangles = {{0, 1, 2}}, .normals = {}, .uv = {}});
      if (away) scene.meshes[0].triangles[0] = {0, 2, 1};
      const int front = emissive(scene);
      scene.materials[size_t(front)]->emits_in_front = true;
      scene.instances.push_back({.mesh = 0, .transform = map, .material = front, .position = {}});
      std::vector<Vec3> corners{a, a + u, a + v};
      if (map != Mat4(1.0))
        for (Vec3& corner : corners) corner = mirrored(corner);
      check(scene, away ? 0 : shown(irradiance_of(corners)));
    }

  // From behind, the area light is dark.
  Scene behind = patch({0, 2, 0}, {0.1, 1.3, 0}, 4);
  const int front = emissive(behind);
  behind.materials[size_t(front)]->emits_in_front = true;
  add(behind, make_disk({0, 1.3, 0}, {0, -1, 0}, 0.8), front);
  check(behind, 0);
}

TEST_CASE("area lights next to the floor follow Lambert's formula, with little noise") {
  const auto lit = [](std::unique_ptr<Shape> shape, const std::vector<Vec3>& corners) {
    Scene scene = floor(64);
    scene.camera.eye = {0.15, 0.04, 0.1};
    add(scene, std::move(shape), emissive(scene));
    const double expected = shown(irradiance_of(corners));
    check(scene, expected);
    // Sampling by area has 1.3 to 14 times as much noise, and fewer samples five times as much.
    const double most = 2e-3 * test::amount(5, 1, 1);
    for (const Backend backend : {Backend::twin, Backend::reference}) {
      const double noise = estimate(scene, backend).error / expected;
      CAPTURE(noise);
      CHECK(noise < most);
    }
  };
  // The floor's point is before the light, under its corner, and under its middle; then the light leans, or
  // is a triangle.
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const auto both = [&](const Vec3& a, const Vec3& u, const Vec3& v) {
    lit(make_parallelogram(a, u, v), {a, a + u, a + u + v, a + v});
  };
  both({-1, 0, 0.2}, 2.0 * x, y);
  both({-1.02, 0.1, -1.02}, x, z);
  both({-0.5, 0.05, -0.5}, x, z);
  both({-0.6, 0.01, 0.15}, x, 0.2 * x + y + 0.3 * z);
  const Vec3 a(-0.2, 0.01, -0.1), b(0.9, 0.02, 0.1), c(0.1, 1.1, -0.3);
  lit(make_triangle({.vertices = {a, b, c}}), {a, b, c});
}

TEST_CASE("each part of a textured area light is as bright as its texel") {
  const Vec3 a(-0.5, 0.6, 0.2), u(1.2, 0.5, 0.2), v(0.6, 0.3, 1);
  const double left = irradiance_of({a, a + u / 2.0, a + u / 2.0 + v, a + v}),
               right = irradiance_of({a + u / 2.0, a + u, a + u + v, a + u / 2.0 + v});
  const auto picture = [](Scene& scene, const Vec2& size) {
    return add(scene, make_phong({.diffuse = gray(0),
                                  .emission = textures::make_checker(Vec3(4), Vec3(0.5), size)}));
  };
  Scene scene = floor(1024);
  add(scene, make_parallelogram(a, u, v), picture(scene, {0.5, 1}));
  check(scene, shown(4 * left + 0.5 * right), 1e-4);

  // The area light as a mesh with colours, its uv rotated by a right angle.
  Scene mesh = floor(1024);
  mesh.meshes.push_back({.name = "",
                         .positions = {a, a + u, a + u + v, a + v},
                         .triangles = {{0, 1, 2}, {0, 2, 3}},
                         .normals = {},
                         .uv = {{0, 0}, {0, 1}, {1, 1}, {1, 0}},
                         .colors = {Vec3(0.5), Vec3(0.5), Vec3(0.5), Vec3(0.5)}});
  mesh.instances.push_back(
      {.mesh = 0, .transform = Mat4(1.0), .material = picture(mesh, {1, 0.5}), .position = {}});
  check(mesh, shown(2 * left + 0.25 * right), 1e-4);

  // The picture reads the second uv; all first uv are in its dark half.
  Scene second = floor(1024);
  const auto halves = std::make_shared<ImageTexture>();
  halves->width = 2;
  halves->height = 1;
  halves->texels = {{255, 255, 255, 255}, {51, 51, 51, 255}};
  halves->srgb = false;
  halves->filter = Filter::nearest;
  Mesh with_second = mesh.meshes[0];
  with_second.uv.assign(4, Vec2(0.75, 0.5));
  with_second.colors.clear();
  with_second.second_uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  second.meshes.push_back(with_second);
  const int glow =
      add(second, make_phong({.diffuse = gray(0),
                              .emission = textures::make_image(halves, Vec3(4), {.second_uv = true})}));
  second.instances.push_back({.mesh = 0, .transform = Mat4(1.0), .material = glow, .position = {}});
  check(second, shown(4 * left + 0.8 * right), 1e-4);
  // If the camera sees the area light itself, its radiance is the one with which it lights the floor.
  for (const IntegratorType integrator : {IntegratorType::path, IntegratorType::whitted})
    for (const auto& [share, radiance] : {std::pair(0.3, 4.0), std::pair(0.7, 0.8)}) {
      Scene seen = patch({0, 0, 0}, a + share * u + 0.5 * v, 4);
      seen.render.integrator = integrator;
      seen.meshes.push_back(with_second);
      seen.materials.push_back(make_phong(
          {.diffuse = gray(0), .emission = textures::make_image(halves, Vec3(4), {.second_uv = true})}));
      seen.instances.push_back({.mesh = 0, .transform = Mat4(1.0), .material = 0, .position = {}});
      check(seen, radiance);
    }

  // A globe whose southern half faces the floor.
  Scene globe = floor(1024);
  add(globe, make_sphere({0, 2, 0}, 0.5), picture(globe, {2, 0.5}));
  check(globe, shown(4 * M_PI * 0.25 / 4), 1e-4);
}

TEST_CASE("area lights of an instanced group shine at each instance") {
  Scene scene = floor(1024);
  const int material = emissive(scene);
  Group group;
  group.shapes.push_back(make_sphere({0, 0, 0}, 0.2));
  group.shapes[0]->material = material;
  scene.meshes.push_back({.name = "",
                          .positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},
                          .triangles = {{0, 1, 2}},
                          .normals = {},
                          .uv = {}});
  group.instances.push_back({.mesh = 0,
                             .transform = glm::scale(glm::translate(Mat4(1.0), Vec3(0.5, 0.3, 0)), Vec3(0.5)),
                             .material = material,
                             .position = {}});
  scene.groups.push_back(std::move(group));
  double expected = 0;
  for (const Vec3& at : {Vec3(0.3, 1.6, 0.2), Vec3(-0.7, 1.2, -0.6)}) {
    Mat4 map = glm::translate(Mat4(1.0), at);
    map[1].y = -1;
    scene.group_instances.push_back({.group = 0,
                                     .transform = map,
                                     .shapes_before = scene.shapes.size(),
                                     .instances_before = 0,
                                     .position = {}});
    const double h = glm::length(at);
    const Vec3 corner = at + Vec3(0.5, -0.3, 0);
    expected += M_PI * 0.04 / (h * h) * (at.y / h) +
                irradiance_of({corner, corner + Vec3(0.5, 0, 0), corner + Vec3(0, 0, 0.5)});
  }
  check(scene, shown(expected), 1e-4);
}
