// Compares path tracing with known answers: all executors share its formula, so comparing the executors with
// each other cannot test it. Each picture shows one small patch, so that its pixels are 64 estimates of one
// value, independent of each other. A test whose error is above half a percent could not fail, and is an
// error itself.
#include "host/formula/formula.hpp"
#include "patch.hpp"
#include "tests/support/environments.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::test;
using executors::Backend;

TEST_CASE("point and directional lights agree with Whitted's: L = ρ I cos θ / d²") {
  Scene scene = floor(4);
  add_point_light(scene, {0, 2, 0}, Vec3(3), Falloff::inverse_square);
  check(scene, albedo * 3 / 4, 1e-5);
  add_sun(scene, {0, 1, 1}, Vec3(0.5));
  scene.image.samples = 256;
  check(scene, albedo * (3.0 / 4 + 0.5 * std::sqrt(0.5)));
}

TEST_CASE("a sun's angular size keeps its irradiance and makes it visible; beside an environment too") {
  for (const double degrees : {0.05, 0.533, 40.0}) {
    CAPTURE(degrees);
    Scene scene = floor();
    add_sun(scene, {0, 1, 1}, Vec3(0.5), glm::radians(degrees));
    check(scene, albedo * 0.5 * std::sqrt(0.5), 1e-5);
    scene.environment = environment(4, 2, [](const Vec3&) { return Vec3(0.25); });
    check(scene, albedo * (0.5 * std::sqrt(0.5) + 0.25), 1e-5);

    Scene above = patch({0, 1, 0}, {0, 2, 1}, 4);
    add_sun(above, {0, 1, 1}, Vec3(0.5), glm::radians(degrees));
    check(above, 0.5 / std::pow(std::sin(glm::radians(degrees / 2)), 2), 1e-4);
    const double beside = M_PI / 4 + 1.1 * glm::radians(degrees / 2);
    above.camera.target = above.camera.eye + Vec3(0, std::cos(beside), std::sin(beside));
    check(above, 0, 1e-4);
  }
}

TEST_CASE("a spot has I s² cos θ / d², where s goes from one angle's cosine to the other's") {
  const double inner = 0.3, outer = 0.7;
  const auto seen = [&](double angle, double distance) {
    const double s = (std::cos(angle) - std::cos(outer)) / (std::cos(inner) - std::cos(outer));
    return albedo * 3 * std::pow(std::clamp(s, 0.0, 1.0), 2) / (distance * distance);
  };
  for (const double angle : {0.0, 0.25, 0.5, 0.69, 0.75}) {
    CAPTURE(angle);
    Scene scene = floor(4);
    add_spot(scene, {{0, 2, 0}, {std::sin(angle), -std::cos(angle), 0}, Vec3(3), inner, outer});
    check(scene, seen(angle, 2), 1e-5);
    scene.render.integrator = IntegratorType::whitted;
    check(scene, seen(angle, 2), 1e-5);
  }
}

TEST_CASE("a sphere above the horizon: E = π L R² cos θ / d²") {
  Scene scene = floor();
  add(scene, make_sphere({0, 1.6, 1.2}, 0.7), emissive(scene));
  check(scene, shown(M_PI * 0.7 * 0.7 * 0.8 / 4));
}

TEST_CASE("a distant, small sphere is lit correctly although its cone's 1 − cos vanishes") {
  Scene scene = floor(16);
  add(scene, make_sphere({0, 1000, 0}, 0.01), emissive(scene, 1e6));
  check(scene, shown(M_PI * 1e6 * 1e-10), 1e-5);
}

TEST_CASE("a sphere that the horizon cuts (Snyder 1996)") {
  const double radius = 0.9, distance = 1.5, theta = 1.2;
  Scene scene = floor(1024);
  add(scene, make_sphere(distance * Vec3(0, std::cos(theta), std::sin(theta)), radius), emissive(scene));
  const double h = distance / radius, x = std::sqrt(h * h - 1), y = -x / std::tan(theta);
  const double root = std::sin(theta) * std::sqrt(1 - y * y);
  check(scene, shown((std::cos(theta) * std::acos(y) - x * root) / (h * h) + std::atan(root / x)));
}

TEST_CASE("a disk above the floor, off its axis, and a ring") {
  const double h = 1.3, a = 0.6;
  const auto irradiance = [&](double radius) {
    const double sum = h * h + a * a, square = radius * radius;
    return M_PI / 2 * (1 - (sum - square) / std::sqrt((sum + square) * (sum + square) - 4 * a * a * square));
  };
  Scene disk = floor();
  add(disk, make_disk({a, h, 0}, {0, -1, 0}, 0.8), emissive(disk));
  check(disk, shown(irradiance(0.8)));
  Scene ring = floor();
  add(ring, make_disk({a, h, 0}, {0, 1, 0}, 0.8, 0.5), emissive(ring));
  check(ring, shown(irradiance(0.8) - irradiance(0.5)));
}

TEST_CASE("polygons above the horizon (Lambert 1760): a triangle, a parallelogram, a mesh of both") {
  const Vec3 a(-0.5, 0.6, 0.2), b(0.7, 1.1, 0.4), c(0.1, 0.9, 1.2);
  const double of_triangle = irradiance_of({a, b, c}), of_both = irradiance_of({a, b, b + c - a, c});

  Scene triangle = floor();
  add(triangle, make_triangle({.vertices = {a, b, c}}), emissive(triangle));
  check(triangle, shown(of_triangle));
  Scene parallelogram = floor();
  add(parallelogram, make_parallelogram(a, b - a, c - a), emissive(parallelogram));
  check(parallelogram, shown(of_both));
  Scene mesh = floor();
  mesh.meshes.push_back({.name = "",
                         .positions = {a, b, c, b + c - a},
                         .triangles = {{0, 1, 2}, {1, 3, 2}},
                         .normals = {},
                         .uv = {}});
  mesh.instances.push_back({.mesh = 0, .transform = Mat4(1.0), .material = emissive(mesh), .position = {}});
  check(mesh, shown(of_both));
}

TEST_CASE("opposite and adjacent faces of a closed cube: their form factors") {
  // The picture shows the whole face, so its mean is the mean over the face.
  const auto face = [](bool opposite) {
    Scene scene = patch({0.5, 0.5, 0.5}, {0.5, 0, 0.5}, 1024);
    scene.camera.projection = cameras::make_projection(OrthographicCamera{.size = 0.5});
    scene.camera.up = {0, 0, 1};
    const int white = add(scene, make_phong({.diffuse = gray(albedo)})), hot = emissive(scene);
    add(scene, make_parallelogram({0, 0, 0}, {1, 0, 0}, {0, 0, 1}), white);
    add(scene,
        opposite ? make_parallelogram({0, 1, 0}, {1, 0, 0}, {0, 0, 1})
                 : make_parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1}),
        hot);
    return scene;
  };
  // Pixels see different values here: the error is a bound, not an estimate.
  const auto mean_of = [](const Scene& scene, Backend backend) { return estimate(scene, backend).mean; };
  for (const Backend backend : {Backend::twin, Backend::reference}) {
    CHECK(mean_of(face(true), backend) == doctest::Approx(shown(M_PI * 0.1998248957)).epsilon(0.001));
    CHECK(mean_of(face(false), backend) == doctest::Approx(shown(M_PI * 0.2000437761)).epsilon(0.002));
  }
}

TEST_CASE("a uniform background lights a floor, and half of it beside a wall") {
  Scene open = floor();
  open.render.background = Vec3(2);
  check(open, albedo * 2);
  Scene walled = floor(1024);
  walled.render.background = Vec3(2);
  add(walled, make_plane({-1e-6, 0, 0}, {1, 0, 0}), add(walled, make_phong({.diffuse = gray(0)})));
  walled.camera.target = {1e-4, 0, 0};
  check(walled, albedo * 1, 2e-3);
}

TEST_CASE("a uniform environment lights like a background, whatever its size") {
  for (const auto& size : {std::pair(1, 1), std::pair(1, 5), std::pair(7, 1), std::pair(16, 8)}) {
    const int width = size.first, height = size.second;
    CAPTURE(width);
    Scene open = floor();
    open.environment = environment(width, height, [](const Vec3&) { return Vec3(2); });
    check(open, albedo * 2);
  }
  Scene walled = floor(1024);
  walled.environment = environment(5, 4, [](const Vec3&) { return Vec3(2); });
  add(walled, make_plane({-1e-6, 0, 0}, {1, 0, 0}), add(walled, make_phong({.diffuse = gray(0)})));
  walled.camera.target = {1e-4, 0, 0};
  check(walled, albedo * 1, 2e-3);
}

TEST_CASE("an environment L(1 + a ω·z), its axis at an angle γ to the floor's: E = π L (1 + ⅔ a cos γ)") {
  for (const double turn : {0.0, 0.37}) {
    const Vec3 axis = glm::normalize(Vec3(0.3, 0.6, -0.7));
    Scene scene = floor();
    scene.environment =
        environment(256, 128, [&](const Vec3& d) { return Vec3(2 * (1 + 0.9 * glm::dot(d, axis))); }, turn);
    check(scene, shown(M_PI * 2 * (1 + 2.0 / 3 * 0.9 * axis.y)), 2e-4);
  }
}

TEST_CASE("an environment L cosⁿ θ above the horizon: E = 2π L / (n + 2); and on its side, a wall") {
  for (const double n : {1.0, 30.0}) {
    Scene scene = floor();
    scene.environment =
        environment(256, 512, [&](const Vec3& d) { return Vec3(3 * std::pow(std::max(0.0, d.y), n)); });
    check(scene, shown(2 * M_PI * 3 / (n + 2)), 2e-4);
  }
  // The lobe, defined around −z and turned to the x axis, lights a wall as a lobe above lights a floor.
  Scene scene = patch({2, 0.3, 0.2}, {0, 0, 0});
  add(scene, make_plane({0, 0, 0}, {1, 0, 0}), add(scene, make_phong({.diffuse = gray(albedo)})));
  scene.environment = environment(
      512, 256, [&](const Vec3& d) { return Vec3(3 * std::pow(std::max(0.0, -d.z), 30)); }, -0.25);
  check(scene, shown(2 * M_PI * 3 / 32), 1e-3);
}

TEST_CASE("an environment and area lights add up, whatever the probability of each") {
  for (const double share : {0.1, 0.5, 0.95}) {
    Scene scene = floor(1024);
    const auto around = environment(16, 8, [](const Vec3&) { return Vec3(0.5); });
    around->share = share;
    scene.environment = around;
    add(scene, make_sphere({0, 1.6, 1.2}, 0.7), emissive(scene, 2));
    add_point_light(scene, {1.6, 1.2, 0}, Vec3(0.3), Falloff::inverse_square);
    // The area light covers a part of the environment.
    const double of_emitter = M_PI * 0.7 * 0.7 * 0.8 / 4;
    check(scene, shown(0.5 * (M_PI - of_emitter) + 2 * of_emitter) + albedo * 0.3 * 0.6 / 4, 1e-4);
  }
}

TEST_CASE("a single bright texel is found, and has its exact irradiance") {
  Scene scene = floor();
  image::Image picture(64, 32, 3);
  std::fill_n(picture.pixel(40, 9), 3, 5000.0f);
  scene.environment = std::make_shared<EnvironmentMap>(std::move(picture), 0.1);
  // ∫ of the texel's tent function times cos θ sin θ. The integral over rows is by Simpson's rule; the one
  // over columns is a texel's width.
  double sum = 0;
  constexpr int steps = 2000;
  for (int i = 0; i <= steps; ++i) {
    const double v = -1 + 2.0 * i / steps, polar = M_PI * (9.5 + v) / 32;
    sum += (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * (1 - std::abs(v)) * std::cos(polar) * std::sin(polar);
  }
  check(scene, shown(5000 * (2 * M_PI / 64) * (M_PI / 32) * sum * (2.0 / steps) / 3), 1e-4);
}

TEST_CASE("two endless facing walls: L₁ = L / (1 − ρ₁ρ₂), L₂ = ρ₂ L₁") {
  Scene scene = patch({0, 0.5, 0}, {0.1, 0, 0.1}, 1024);
  scene.render.max_depth = 64;
  add(scene, make_plane({0, 0, 0}, {0, 1, 0}),
      add(scene, make_phong({.diffuse = gray(0.5), .emission = gray(1)})));
  add(scene, make_plane({0, 1, 0}, {0, -1, 0}), add(scene, make_phong({.diffuse = gray(0.6)})));
  check(scene, 1 / (1 - 0.5 * 0.6), 1e-4);
  scene.camera.target = {0.1, 1, 0.1};
  check(scene, 0.6 / (1 - 0.5 * 0.6), 1e-4);
}

TEST_CASE("inside a sphere, emitted light and a point's light agree with closed forms") {
  Scene own = patch({0.1, 0.2, 0.3}, {0.1, 0, -2}, 256);
  own.render.max_depth = 64;
  add(own, make_sphere({0, 0, 0}, 2), add(own, make_phong({.diffuse = gray(0.6), .emission = gray(1)})));
  check(own, 1 / (1 - 0.6), 1e-4);

  Scene point = patch({0.1, 0.2, 0.3}, {0, 0, -2}, 1024);
  point.render.max_depth = 64;
  add(point, make_sphere({0, 0, 0}, 2), add(point, make_phong({.diffuse = gray(0.6)})));
  add_point_light(point, {0, 0, 1}, Vec3(5), Falloff::inverse_square);
  const double direct = M_PI * 5 / 9, mean = M_PI * 5 / 4;
  check(point, 0.6 / M_PI * (direct + 0.6 * mean / (1 - 0.6)), 1e-4);
}

TEST_CASE("glass loses no light: a ball of it in a furnace, and a pane before an area light") {
  Scene ball = patch({0, 0, 4}, {0.3, 0.4, 0}, 1024);
  ball.render.background = Vec3(1);
  ball.render.max_depth = 64;
  add(ball, make_sphere({0, 0, 0}, 1), add(ball, make_dielectric({.ior = 1.5})));
  check(ball, 1, 1e-5);

  // At normal incidence, T = (1 − R)² / (1 − R²).
  Scene pane = patch({0, 0, 4}, {0, 0, 0}, 1024);
  pane.render.max_depth = 64;
  add(pane, make_box({-1, -1, 0}, {1, 1, 0.1}), add(pane, make_dielectric({.ior = 1.5})));
  add(pane, make_disk({0, 0, -1}, {0, 0, 1}, 1), emissive(pane));
  check(pane, 0.923077, 1e-5);
}

TEST_CASE("an area light between two mirrors shows Σ rⁿ") {
  Scene scene = patch({0, 0, 0.5}, {0, 0, 0}, 1024);
  scene.render.max_depth = 64;
  const int mirror = add(scene, make_mirror({.reflectance = gray(0.9)}));
  add(scene, make_plane({0, 0, 0}, {0, 0, 1}), mirror);
  add(scene, make_plane({0, 0, 1}, {0, 0, -1}), mirror);
  // The area light stands to one side.
  scene.camera.target = {0.021, 0, 0};
  add(scene, make_plane({0.5, 0, 0}, {-1, 0, 0}), emissive(scene));
  // On its way to x = 0.5 the ray goes 11.9 in z.
  check(scene, std::pow(0.9, 12), 1e-4);
}

TEST_CASE("a white ball lit by a sun behind the eye has two thirds of the frontal radiance on average") {
  Scene scene = patch({0, 0, 4}, {0, 0, 0}, 64);
  scene.camera.projection = cameras::make_projection(OrthographicCamera{.size = 1});
  add(scene, make_sphere({0, 0, 0}, 1), add(scene, make_phong({.diffuse = gray(albedo)})));
  add_sun(scene, {0, 0, 1}, Vec3(1));
  for (const Backend backend : {Backend::twin, Backend::reference})
    CHECK(estimate(scene, backend).mean == doctest::Approx(M_PI / 4 * 2.0 / 3 * albedo).epsilon(1e-3));
}

TEST_CASE("N area lights on a ring are N times one; one behind a wall adds nothing") {
  const auto ring = [](int emitters, int hidden) {
    Scene scene = floor(1024);
    const int material = emissive(scene);
    for (int i = 0; i < emitters; ++i) {
      const double angle = 2 * M_PI * i / emitters;
      add(scene, make_sphere({std::cos(angle), 1, std::sin(angle)}, 0.1), material);
    }
    const int black = add(scene, make_phong({.diffuse = gray(0)}));
    for (int i = 0; i < hidden; ++i) {
      const double angle = 2 * M_PI * i / emitters;
      add(scene, make_sphere({0.5 * std::cos(angle), 0.5, 0.5 * std::sin(angle)}, 0.06), black);
    }
    return scene;
  };
  const double one = shown(M_PI * 0.01 / 2 * std::sqrt(0.5));
  check(ring(7, 0), 7 * one);
  check(ring(7, 2), 5 * one);
}

TEST_CASE("a sphere half behind an edge gives half its light") {
  Scene scene = floor(1024);
  add(scene, make_sphere({0, 2, 0}, 0.5), emissive(scene));
  add(scene, make_parallelogram({0, 1, -50}, {50, 0, 0}, {0, 0, 100}),
      add(scene, make_phong({.diffuse = gray(0)})));
  scene.camera.eye = {-0.4, 0.9, 0.5};
  check(scene, shown(M_PI * 0.25 / 4) / 2, 1e-3);
}

TEST_CASE("a thin lens blurs a straight bright edge by (arccos x − x √(1 − x²)) / π") {
  // The eye looks along −z. Rays that intersect at (0, 0, −focus) are spread over a disk in the plane z = −2.
  const auto edge = [](double e, const Aperture& aperture) {
    Scene scene = patch({0, 0, 0}, {0, 0, -1}, 1024);
    scene.camera.projection =
        cameras::make_projection(PerspectiveCamera{.fov_degrees = 1e-3, .aperture = aperture});
    add(scene, make_parallelogram({e, -5, -2}, {10, 0, 0}, {0, 10, 0}), emissive(scene));
    return scene;
  };
  for (const double focus : {1.25, 4.0, 100.0}) {
    const double confusion = 0.4 * std::abs(1 - 2 / focus);
    for (const double x : {-0.7, 0.0, 0.3, 0.6}) {
      CAPTURE(focus);
      CAPTURE(x);
      check(edge(x * confusion, {.radius = 0.4, .focus = focus}),
            (std::acos(x) - x * std::sqrt(1 - x * x)) / M_PI, 1e-4);
    }
  }
  // A square aperture with upright sides: the blur reaches as far as the sides are from the middle.
  const double side = 0.4 * std::sqrt(0.5) * 0.5;
  check(edge(0.3 * side, {.radius = 0.4, .focus = 4, .blades = 4, .blade_rotation = M_PI / 4}), 0.35, 1e-4);
  // A triangular aperture with a corner at the right. The blur is mirrored if the edge lies behind the focus.
  const auto triangle = [&](double focus) {
    return edge(0.4 * 0.5 * 0.25, {.radius = 0.4, .focus = focus, .blades = 3});
  };
  check(triangle(4), 0.75 * 0.75 / (1.5 * 1.5), 1e-4);
  check(triangle(4.0 / 3), 1 - 1.25 * 1.25 / (1.5 * 1.5), 1e-4);
}

TEST_CASE("a normal map of one colour tilts the surface, and so do bumps on a slope") {
  const Vec3 to_light = glm::normalize(Vec3(0.3, 1, -0.5)), tilted = glm::normalize(Vec3(0.3, 0.9, 0.2));
  for (const IntegratorType integrator : {IntegratorType::path, IntegratorType::whitted}) {
    Scene scene = floor(4);
    scene.render.integrator = integrator;
    add_sun(scene, to_light, Vec3(0.7));
    // On a floor u runs along x and v along −z.
    scene.materials[0]->normal_map =
        NormalMap{textures::make_constant(0.5 + 0.5 * Vec3(tilted.x, -tilted.z, tilted.y))};
    check(scene, albedo * 0.7 * glm::dot(to_light, tilted), 1e-5);
    scene.materials[0]->normal_map->scale = 0.5;
    check(scene,
          albedo * 0.7 * glm::dot(to_light, glm::normalize(Vec3(0.5 * tilted.x, tilted.y, 0.5 * tilted.z))),
          1e-5);

    // Heights that rise evenly, away from the viewer: the mirrored light stays above the floor.
    scene.materials[0]->normal_map.reset();
    scene.materials[0]->bump_map = BumpMap{
        textures::make_formula(std::make_shared<const formula::Formula>(
            formula::FormulaText{"vec3 color(vec2 uv) { return vec3(0.5 - 0.15 * uv.x + 0.1 * uv.y); }", {}},
            std::vector<formula::FormulaParameter>{}, "slope", formula::FormulaKind::color)),
        2, 0.05};
    check(scene, albedo * 0.7 * glm::dot(to_light, glm::normalize(Vec3(0.3, 1, 0.2))), 1e-5);
  }
}
