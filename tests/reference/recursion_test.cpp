// Reflection, refraction and media, against closed forms.
#include <algorithm>

#include "host/reference/media.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::records;
using namespace eyeray::engine::test;

namespace {

// A surface that shows `color` under an ambient light of 1, and nothing else.
std::unique_ptr<Material> glowing(const Vec3& color) {
  return make_phong({.diffuse = gray(0), .ambient = textures::make_constant(color)});
}

// Fresnel's equations as Fresnel wrote them, in angles; unpolarised.
double fresnel_by_angles(double incident, double n1, double n2) {
  const double refracted = std::asin(n1 / n2 * std::sin(incident));
  const double rs = std::sin(incident - refracted) / std::sin(incident + refracted);
  const double rp = std::tan(incident - refracted) / std::tan(incident + refracted);
  return (rs * rs + rp * rp) / 2;
}

double reflected_by(const Material& material, double incident_degrees, double n1, double n2) {
  return material.scattering({Vec2(0), std::cos(glm::radians(incident_degrees)), n1, n2}).reflected.x;
}

}  // namespace

TEST_CASE("Fresnel") {
  const auto glass = make_dielectric({});
  CHECK(reflected_by(*glass, 0, 1, 1.5) == doctest::Approx(0.04).epsilon(1e-14));
  CHECK(reflected_by(*glass, 0, 1.5, 1) == doctest::Approx(0.04).epsilon(1e-14));
  for (double degrees = 1; degrees < 90; degrees += 1) {
    CAPTURE(degrees);
    CHECK(reflected_by(*glass, degrees, 1, 1.5) ==
          doctest::Approx(fresnel_by_angles(glm::radians(degrees), 1, 1.5)).epsilon(1e-12));
  }

  // At Brewster's angle nothing is left of the p-polarised half.
  const double rs = (1.5 * 1.5 - 1) / (1.5 * 1.5 + 1);
  CHECK(reflected_by(*glass, glm::degrees(std::atan(1.5)), 1, 1.5) ==
        doctest::Approx(rs * rs / 2).epsilon(1e-12));

  // Beyond asin(1/1.5) = 41.81° all is mirrored, and nothing is let through.
  CHECK(reflected_by(*glass, 41.8, 1.5, 1) < 0.95);
  CHECK(reflected_by(*glass, 41.82, 1.5, 1) == 1);
  CHECK(glass->scattering({Vec2(0), 0.1, 1.5, 1}).transmitted == Vec3(0));
  CHECK(glass->scattering({Vec2(0), 0.0, 1.5, 1.5}).transmitted == Vec3(1));
}

TEST_CASE("a mirror shows its reflectance of the surroundings") {
  Scene scene = one_pixel({0, 0, 5}, {0.3, 0.2, 0});
  scene.render.background = {0.5, 0.25, 1};
  add(scene, make_sphere({0, 0, 0}, 1),
      add(scene, make_mirror({.reflectance = textures::make_constant(Vec3(0.5, 1, 0.25))})));
  const PixelSample sample = look(scene);
  CHECK(sample.color == Vec3(0.25, 0.25, 0.25));
  CHECK(sample.rays == 2);
  CHECK(sample.hits == 1);
}

TEST_CASE("a mirror's ray leaves at the angle of incidence") {
  Scene scene = one_pixel({-3, 4, 1}, {0, 0, 1});
  scene.render.ambient = Vec3(1);
  add(scene, make_plane({0, 0, 0}, {0, 1, 0}), add(scene, make_mirror({.reflectance = gray(1)})));
  add(scene, make_sphere({3e3, 4e3, 1}, 1e-9), add(scene, glowing({0.2, 0.4, 0.6})));
  CHECK(look(scene).color == Vec3(0.2, 0.4, 0.6));
}

TEST_CASE("depth and throughput end the recursion") {
  // Between two walls that glow with 1 and mirror a half, the eye sees 1 + ½ + ¼ + …
  Scene scene = one_pixel({0, 0, 0}, {0, 0, -1});
  scene.render.ambient = Vec3(1);
  const int wall = add(scene, make_phong({.diffuse = gray(0), .ambient = gray(1), .reflectance = gray(0.5)}));
  add(scene, make_plane({0, 0, -1}, {0, 0, 1}), wall);
  add(scene, make_plane({0, 0, 1}, {0, 0, -1}), wall);
  scene.render.min_throughput = 0;
  for (int depth = 0; depth < 20; ++depth) {
    scene.render.max_depth = depth;
    CHECK(look(scene).color.x == 2 - std::pow(0.5, depth));
    CHECK(look(scene).rays == uint32_t(depth) + 1);
  }
  scene.render.min_throughput = 0.12;
  CHECK(look(scene).rays == 4);
  scene.render.min_throughput = 0.125;  // a weight of exactly the least is not traced
  CHECK(look(scene).rays == 3);
}

TEST_CASE("rounding that hits another check at each mirror stays within the darkest and the brightest") {
  // Between two walls that mirror a half, along a border of both their checks.
  const auto look_with = [](double x, rounding::TextureChoice choice) {
    Scene scene = one_pixel({x, 0.5, 0}, {x, 0.5, -1});
    scene.render.ambient = Vec3(1);
    scene.render.max_depth = 3;
    scene.render.min_throughput = 0;
    const TexturePtr checks = textures::make_checker(Vec3(0.25, 1, 0), Vec3(1, 0.5, 0), Vec2(1));
    const int wall =
        add(scene, make_phong({.diffuse = gray(0), .ambient = checks, .reflectance = gray(0.5)}));
    add(scene, make_plane({0, 0, -1}, {0, 0, 1}), wall);
    add(scene, make_plane({0, 0, 1}, {0, 0, -1}), wall);
    return reference::Renderer(scene).sample(0, 0, 0, {0, 0}, {1e-6, false, 0, choice}).color;
  };
  using enum rounding::TextureChoice;
  for (const double x : {0.0, 1.0, -3.0}) {
    CHECK(look_with(x, darkest) == 1.875 * Vec3(0.25, 0.5, 0));
    CHECK(look_with(x, brightest) == 1.875 * Vec3(1, 1, 0));
  }
  // Farther from the border than the rounding, each mirror has only one colour to choose.
  for (const double x : {0.001, 0.5, -0.001}) {
    CHECK(look_with(x, darkest) == look_with(x, at_hit));
    CHECK(look_with(x, brightest) == look_with(x, at_hit));
  }
}

TEST_CASE("the throughput that ends the recursion includes absorption, and takes the greatest channel") {
  // A mirror deep in dark water: exp(−1) of the light is left on the way, and only of red.
  Scene scene = one_pixel({0, -1, 0}, {0, -2, 0});
  scene.render.background = Vec3(1);
  add(scene, make_plane({0, 0, 0}, {0, 1, 0}),
      add(scene, make_dielectric({.ior = 1, .absorption = {1, 9, 9}})));
  add(scene, make_plane({0, -2, 0}, {0, 1, 0}), add(scene, make_mirror({.reflectance = gray(1)})));
  scene.render.min_throughput = 0.37;
  CHECK(look(scene).rays == 1);
  scene.render.min_throughput = 0.36;
  CHECK(look(scene).rays == 2);

  // The mirrored ray leaves through the surface, after three units of water in all.
  scene.render.min_throughput = 0;
  CHECK(look(scene).color.x == doctest::Approx(std::exp(-3)));
  CHECK(look(scene).color.y == doctest::Approx(std::exp(-27)));
}

TEST_CASE("glass of ior 1 is invisible") {
  Scene scene = one_pixel({0.3, 0.2, 5}, {0.1, -0.3, 0});
  scene.render.ambient = Vec3(1);
  const TexturePtr checks = textures::make_checker(Vec3(1), Vec3(0.25), Vec2(1e-3));
  add(scene, make_plane({0, 0, -20}, {0, 0, 1}),
      add(scene, make_phong({.diffuse = gray(0), .ambient = checks})));
  const int nothing = add(scene, make_dielectric({.ior = 1}));
  Dice dice;
  for (int i = 0; i < 100; ++i) {
    scene.camera.target = {dice.between(-0.6, 0.6), dice.between(-0.6, 0.6), 0};
    const Vec3 without = look(scene).color;
    add(scene, make_sphere({0, 0, 0}, 1), nothing);
    CHECK(look(scene).color == without);
    CHECK(look(scene).rays == 3);
    CHECK(look(scene).hits == 3);
    scene.shapes.pop_back();
  }
}

TEST_CASE("a glass sphere in a uniform world loses no light") {
  Scene scene = one_pixel({0, 0, 5}, {0, 0, 0});
  scene.render.background = {1, 0.5, 0.25};
  scene.render.max_depth = 400;
  scene.render.min_throughput = 1e-14;
  add(scene, make_sphere({0, 0, 0}, 1), add(scene, make_dielectric({.ior = 1.5})));
  Dice dice;
  for (int i = 0; i < 100; ++i) {
    scene.camera.target = {dice.between(-0.7, 0.7), dice.between(-0.7, 0.7), 0};
    CHECK(near(look(scene).color, Vec3(1, 0.5, 0.25), 1e-12));
  }

  // With a depth of one ray, only the light that the front mirrors comes back.
  scene.camera.target = {0, 0, 0};
  scene.render.max_depth = 1;
  CHECK(near(look(scene).color, 0.04 * Vec3(1, 0.5, 0.25), 1e-15));
}

TEST_CASE("light is absorbed with the distance through the medium") {
  Scene scene = one_pixel({0, 0, 5}, {0, 0, 0});
  scene.render.background = Vec3(1);
  add(scene, make_sphere({0, 0, 0}, 1), add(scene, make_dielectric({.ior = 1, .absorption = {0, 1, 2}})));
  CHECK(near(look(scene).color, Vec3(1, std::exp(-2), std::exp(-4)), 1e-12));
  scene.camera.eye = {0.6, 0, 5};
  scene.camera.target = {0.6, 0, 0};
  CHECK(near(look(scene).color, Vec3(1, std::exp(-1.6), std::exp(-3.2)), 1e-12));

  // From inside, only the rest of the way dims the light.
  scene.camera.eye = {0, 0, 0.5};
  scene.camera.target = {0, 0, 0};
  CHECK(near(look(scene).color, Vec3(1, std::exp(-1.5), std::exp(-3)), 1e-12));
}

TEST_CASE("refracted rays obey Snell, and Fresnel splits the light") {
  // Water that absorbs green fills y < 0. A red dot of light lies where Snell's law puts it. A green dot lies
  // in the mirrored direction, whose ray never was in the water.
  const double n = 1.33;
  for (double degrees = 5; degrees < 90; degrees += 10) {
    CAPTURE(degrees);
    const double incident = glm::radians(degrees);
    const double refracted = std::asin(std::sin(incident) / n);
    const double mirrored = fresnel_by_angles(incident, 1, n);
    Scene scene = one_pixel({-std::sin(incident), std::cos(incident), 0}, {0, 0, 0});
    scene.render.ambient = Vec3(1);
    add(scene, make_plane({0, 0, 0}, {0, 1, 0}),
        add(scene, make_dielectric({.ior = n, .absorption = {0, 9, 0}})));
    add(scene, make_sphere(100.0 * Vec3(std::sin(refracted), -std::cos(refracted), 0), 1e-9),
        add(scene, glowing({1, 0, 0})));
    add(scene, make_sphere(100.0 * Vec3(std::sin(incident), std::cos(incident), 0), 1e-9),
        add(scene, glowing({0, 1, 0})));
    CHECK(near(look(scene).color, Vec3(1 - mirrored, mirrored, 0), 1e-12));

    // The reverse way, from a point in the water on the refracted ray.
    scene.camera.eye = 0.5 * Vec3(std::sin(refracted), -std::cos(refracted), 0);
    scene.shapes.pop_back();
    add(scene, make_sphere(100.0 * Vec3(-std::sin(incident), std::cos(incident), 0), 1e-9),
        add(scene, glowing({0, 0, 1})));
    CHECK(near(look(scene).color, Vec3(0, 0, 1 - mirrored), 1e-12));
  }
}

TEST_CASE("beyond the critical angle the surface of water is a mirror") {
  Scene scene = one_pixel({0, -1, 0}, {std::tan(glm::radians(49.0)), 0, 0});  // the critical angle is 48.75°
  scene.render.ambient = Vec3(1);
  add(scene, make_plane({0, 0, 0}, {0, 1, 0}), add(scene, make_dielectric({.ior = 1.33})));
  add(scene, make_plane({0, -9, 0}, {0, 1, 0}), add(scene, glowing({1, 0, 0})));
  add(scene, make_plane({0, 9, 0}, {0, -1, 0}), add(scene, glowing({0, 1, 0})));
  CHECK(look(scene).color == Vec3(1, 0, 0));
  scene.camera.target.x = std::tan(glm::radians(48.5));
  const double mirrored = fresnel_by_angles(glm::radians(48.5), 1.33, 1);
  CHECK(near(look(scene).color, Vec3(mirrored, 1 - mirrored, 0), 1e-10));
}

TEST_CASE("a hollow glass ball: four surfaces, each between glass and air") {
  Scene scene = one_pixel({0, 0, 5}, {0, 0, 0});
  scene.render.ambient = Vec3(1);
  scene.render.max_depth = 4;
  const int air = add(scene, make_dielectric({.ior = 1}));
  const int glass = add(scene, make_dielectric({.ior = 1.4, .absorption = Vec3(2)}));
  add(scene, make_sphere({0, 0, 0}, 1), glass);
  add(scene, make_sphere({0, 0, 0}, 0.96), air);
  add(scene, make_plane({0, 0, -3}, {0, 0, 1}), add(scene, glowing(Vec3(1))));
  const double mirrored = std::pow(0.4 / 2.4, 2);
  CHECK(near(look(scene).color, Vec3(std::pow(1 - mirrored, 4) * std::exp(-2 * 0.08)), 1e-11));
  CHECK(look(scene).flags == 0);
}

TEST_CASE("overlapping media may be left in any order") {
  // The ray enters A, enters B, leaves A and leaves B. Between A and B nothing changes, because their iors
  // agree.
  Scene scene = one_pixel({0, 0, 5}, {0, 0, 0});
  scene.render.ambient = Vec3(1);
  scene.render.max_depth = 4;
  add(scene, make_sphere({0, 0, 0.5}, 1), add(scene, make_dielectric({.ior = 1.5})));
  add(scene, make_sphere({0, 0, -0.5}, 1), add(scene, make_dielectric({.ior = 1.5})));
  add(scene, make_plane({0, 0, -3}, {0, 0, 1}), add(scene, glowing(Vec3(1))));
  CHECK(near(look(scene).color, Vec3(0.96 * 0.96), 1e-12));
}

TEST_CASE("a fifth nested medium is not entered, and is flagged") {
  Scene scene = one_pixel({0, 0, 9}, {0, 0, 0});
  scene.render.background = Vec3(1);
  scene.render.max_depth = 20;
  for (int i = 0; i < 4; ++i)
    add(scene, make_sphere({0, 0, 0}, 5 - i), add(scene, make_dielectric({.ior = 1})));
  CHECK(look(scene).flags == 0);
  add(scene, make_sphere({0, 0, 0}, 1), add(scene, make_dielectric({.ior = 1.5})));
  const PixelSample sample = look(scene);
  CHECK(sample.flags == media_overflow);
  CHECK(near(sample.color, Vec3(1), 1e-15));
  scene.camera.eye = {0, 0, 0.5};
  CHECK(look(scene).flags == media_overflow);
}

namespace {

// A shape whose search gives up: it only knows that no hit is before `sure_until`.
class GivesUp final : public Shape {
 public:
  explicit GivesUp(double sure_until) : sure_until_(sure_until) {}
  std::optional<Intersection> intersect(const Ray&) const override {
    return Intersection{.t = sure_until_, .iteration_limit = true};
  }
  SurfacePoint surface(const Ray&, const Intersection&) const override { return {}; }
  Bounds bounds() const override { return {Vec3(-1e3), Vec3(1e3)}; }
  void pack(Packer&) const override {}

 private:
  double sure_until_;
};

}  // namespace

TEST_CASE("a shape at its iteration limit is no hit, and is flagged where it might have been the nearest") {
  Scene scene = one_pixel({0, 0, 5}, {0, 0, 0});
  scene.render.ambient = Vec3(1);
  const int white = add(scene, glowing(Vec3(1)));
  add(scene, make_sphere({0, 0, 0}, 1), white);
  for (const double sure_until : {3.9, 4.1}) {
    scene.shapes.resize(1);
    add(scene, std::make_unique<GivesUp>(sure_until), white);
    for (const Acceleration acceleration : {Acceleration::bvh, Acceleration::brute_force}) {
      const reference::Renderer renderer(scene, acceleration);
      CHECK(renderer.sample(0, 0, 0).flags == (sure_until < 4 ? iteration_limit : 0u));
      CHECK(renderer.first_hit(0, 0).flags == (sure_until < 4 ? iteration_limit : 0u));
      CHECK(renderer.first_hit(0, 0).t == doctest::Approx(4));
    }
  }

  // The light is at a distance of 2 from the point that the ray hits.
  scene.shapes.resize(1);
  scene.shapes.push_back(nullptr);
  add_point_light(scene, {0, 0, 3}, Vec3(1));
  for (const double sure_until : {1.9, 2.1}) {
    scene.shapes[1] = std::make_unique<GivesUp>(sure_until);
    const reference::Tracer tracer(scene);
    uint32_t flags = 0;
    CHECK(tracer.transmittance({{0, 0, 1.001}, {0, 0, 1}}, 2, flags) == 1);
    CHECK(flags == (sure_until < 2 ? iteration_limit : 0u));
    // If a surface blocks all light, a search that gave up elsewhere on the way sets no flag.
    flags = 0;
    CHECK(tracer.transmittance({{0, 0, 5}, {0, 0, -1}}, 10, flags) == 0);
    CHECK(flags == 0);
  }
}

TEST_CASE("media_at lists the media around a point, outermost first") {
  Scene scene = test::empty_scene();
  const int water = add(scene, make_dielectric({.ior = 1.33}));
  const int glass = add(scene, make_dielectric({.ior = 1.5}));
  const int air = add(scene, make_dielectric({.ior = 1}));
  const int paint = add(scene, make_phong({}));
  add(scene, make_plane({0, 0, 0}, {0, 1, 0}), water);
  add(scene, make_sphere({0, 0, 0}, 4), paint);
  add(scene, make_sphere({0, -5, 0}, 2), glass);
  add(scene, make_sphere({0, -5, 0}, 1.5), air);
  using Media = std::vector<int>;
  CHECK(reference::media_at(scene, {0, 1, 0}) == Media{});
  CHECK(reference::media_at(scene, {0, -1, 0}) == Media{water});
  CHECK(reference::media_at(scene, {9, -1e6, 5}) == Media{water});
  CHECK(reference::media_at(scene, {0, -3.2, 0}) == Media{water, glass});
  CHECK(reference::media_at(scene, {0.1, -5, 0.2}) == Media{water, glass, air});

  // A ceiling of glass, which the ray that media_at() sends ahead does not leave.
  add(scene, make_plane({0, 50, 0}, {0, -1, 0}), glass);
  CHECK(reference::media_at(scene, {0, 60, 0}) == Media{glass});
  CHECK(reference::media_at(scene, {0, 20, 0}) == Media{});
}

TEST_CASE("media_at agrees with the spheres' own equations") {
  Dice dice;
  Scene scene = test::empty_scene();
  std::vector<std::pair<Vec3, double>> spheres;
  for (int i = 0; i < 6; ++i) {
    spheres.emplace_back(dice.in_box(1), dice.between(0.2, 1.5));
    add(scene, make_sphere(spheres.back().first, spheres.back().second), add(scene, make_dielectric({})));
  }
  for (int i = 0; i < 20000; ++i) {
    const Vec3 point = dice.in_box(2);
    std::vector<int> expected;
    for (int s = 0; s < 6; ++s)
      if (glm::length(point - spheres[size_t(s)].first) < spheres[size_t(s)].second) expected.push_back(s);
    std::vector<int> found = reference::media_at(scene, point);
    std::sort(found.begin(), found.end());
    REQUIRE(found == expected);
  }
}
