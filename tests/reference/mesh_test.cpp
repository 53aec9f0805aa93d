// Meshes and their instances in the reference, compared with shapes and closed forms.
#include "tests/support/empty_scene.hpp"
#include "tests/support/meshes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::test;

namespace {

// A scene with light, shadow, a mirror, glass and a floor, to which tests add an object.
Scene studio() {
  Scene scene = test::empty_scene();
  scene.image = {.width = 48, .height = 36};
  scene.camera.eye = {2.5, 3, 6};
  scene.render.background = {0.2, 0.3, 0.5};
  scene.render.ambient = Vec3(0.3);
  scene.render.max_depth = 6;
  add_point_light(scene, {4, 6, 3}, Vec3(1));
  add_sun(scene, {-1, 2, 0.5}, Vec3(0.4));
  add(scene, make_plane({0, -1.5, 0}, {0, 1, 0}), add(scene, make_phong({.diffuse = gray(0.8)})));
  add(scene, make_sphere({-3, 0, -3}, 1.5), add(scene, make_mirror({.reflectance = gray(0.8)})));
  return scene;
}

// The greatest difference between the colours of two scenes' pixels, and whether the first hits' t, normal
// and uv are within the tolerance.
double color_difference(const Scene& a, const Scene& b, double tolerance) {
  const reference::Renderer first(a), second(b);
  double worst = 0;
  for (int y = 0; y < a.image.height; ++y)
    for (int x = 0; x < a.image.width; ++x) {
      const PixelSample p = first.sample(x, y, 0), q = second.sample(x, y, 0);
      worst = std::max(worst, magnitude(p.color - q.color));
      CHECK(p.hits == q.hits);
      CHECK(p.flags == q.flags);
      const FirstHit g = first.first_hit(x, y), h = second.first_hit(x, y);
      CHECK(g.primitive == h.primitive);
      CHECK(g.material == h.material);
      if (g.primitive < 0 || h.primitive < 0) continue;
      CHECK(near(g.t, h.t, tolerance * h.t));
      CHECK(near(g.position, h.position, tolerance * 10));
      CHECK(near(g.normal, h.normal, tolerance));
      CHECK(near(Vec3(g.uv, 0), Vec3(h.uv, 0), tolerance));
    }
  return worst;
}

}  // namespace

TEST_CASE("a cube as a mesh is the cube of twelve triangles, pixel by pixel") {
  for (const bool glass : {false, true}) {
    Scene with_mesh = studio(), with_shapes = studio();
    for (Scene* scene : {&with_mesh, &with_shapes}) {
      // Each triangle of a mesh lets the square root of `shadow` through, so the mesh gets the square of the
      // shapes' value.
      const double shadow = scene == &with_mesh ? 0.25 : 0.5;
      const int material =
          glass ? add(*scene, make_dielectric({.absorption = {0.1, 0.4, 0.3}, .shadow = shadow}))
                : add(*scene, make_phong({.diffuse = gray(0.7)}));
      scene == &with_mesh ? add_instance(*scene, add(*scene, cube()), material)
                          : add_triangles(*scene, cube(), material);
    }
    CHECK(color_difference(with_mesh, with_shapes, 1e-14) < 1e-12);
  }
}

TEST_CASE("an instance is the mesh with its vertices moved") {
  Dice dice;
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    const Mat4 map = glm::scale(random_map(dice, 0.2, 1), Vec3(i % 4 == 3 ? -0.8 : 1));
    Mesh mesh = i % 2 == 0 ? cube() : globe(12, 7);
    Scene with_instance = studio(), baked = studio();
    for (Scene* scene : {&with_instance, &baked}) {
      const TexturePtr checks = textures::make_checker(Vec3(0.9), Vec3(0.2), Vec2(0.25));
      const int paint = add(*scene, make_phong({.diffuse = checks, .reflectance = gray(0.2)}));
      if (scene == &with_instance) {
        add_instance(*scene, add(*scene, mesh), paint, map);
      } else {
        add_triangles(*scene, mesh, paint, map);
      }
    }
    CHECK(color_difference(with_instance, baked, 1e-12) < 1e-9);
  }
}

TEST_CASE("primitives count the shapes, then each instance's triangles") {
  Scene scene = one_pixel({0, 0, 9}, {0.1, 0.2, 0});
  const int paint = add(scene, make_phong({}));
  const int other = add(scene, make_phong({}));
  add(scene, make_sphere({0, 0, -50}, 1), paint);
  add(scene, Mesh{});
  const int box = add(scene, cube());
  add_instance(scene, box, paint, translation({0, 0, -20}));
  add_instance(scene, 0, paint);
  add_instance(scene, box, other, translation({0, 0, 5}));
  CHECK(scene.primitive_count() == 25);
  const FirstHit hit = reference::Renderer(scene).first_hit(0, 0);
  CHECK(hit.primitive == 1 + 12 + 11);  // the upper left half of the cube's front
  CHECK(hit.material == other);
  CHECK(near(hit.position.z, 6, 1e-15));
}

TEST_CASE("the lowest primitive wins among equal hits: shapes, instances, triangles") {
  for (const Acceleration acceleration : {Acceleration::bvh, Acceleration::brute_force}) {
    // The same square many times: from the sixth triangle of a mesh on, in instances, and as a shape.
    Mesh squares = make_mesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-3, -1, 0}, {3, -1, 0}}, {});
    for (int i = 0; i < 5; ++i) squares.triangles.push_back({1, 5, 2});
    for (int i = 0; i < 20; ++i) squares.triangles.push_back({0, 1, 2});
    Scene scene = one_pixel({0.25, -0.5, 3}, {0.25, -0.5, 0});
    const int paint = add(scene, make_phong({}));
    const int mesh = add(scene, squares);
    add_instance(scene, mesh, paint, translation({0, 0, -1}));
    for (int i = 0; i < 9; ++i) add_instance(scene, mesh, paint);
    CHECK(reference::Renderer(scene, acceleration).first_hit(0, 0).primitive == 25 + 5);
    add(scene, make_sphere({0, 0, -9}, 1), paint);
    add(scene, make_triangle({.vertices = {{{-3, -1, 0}, {3, -1, 0}, {0, 9, 0}}}}), paint);
    add(scene, make_triangle({.vertices = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}}}}), paint);
    CHECK(reference::Renderer(scene, acceleration).first_hit(0, 0).primitive == 1);
  }
}

TEST_CASE("under a mirror the outside stays outside, and normals follow the surface") {
  Mesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  mesh.normals = {{0, 0, 1}, glm::normalize(Vec3(1, 0, 1)), {0, 0, 1}};
  mesh.uv = {{2, 3}, {4, 3}, {2, 7}};
  const reference::MeshGeometry geometry(mesh, Acceleration::bvh);
  const auto at = [&](const Mat4& map, const Vec3& target) {
    const reference::InstanceGeometry instance({0, map, 0, {}}, geometry);
    const Vec3 world(map * Vec4(target, 1));
    const Ray ray{world + Vec3(0.3, 0.2, 4), Vec3(-0.3, -0.2, -4)};
    const auto hit = instance.intersect(ray);
    REQUIRE(hit);
    CHECK(near(hit->t, 1, 1e-14));
    const SurfacePoint point = instance.surface(ray, *hit);
    CHECK(near(point.position, world, 1e-14));
    CHECK(near(Vec3(point.uv, 0), Vec3(2 + 2 * target.x, 3 + 4 * target.y, 0), 1e-14));
    return point;
  };
  const Vec3 target(0.5, 0.25, 0);
  const Vec3 normal = 0.25 * mesh.normals[0] + 0.5 * mesh.normals[1] + 0.25 * mesh.normals[2];
  CHECK(near(at(Mat4(1), target).normal_geometric, {0, 0, 1}, 1e-15));
  CHECK(near(at(Mat4(1), target).normal, glm::normalize(normal), 1e-15));

  // A mirror across x = 0, one across z = 0, and a slope: z' = z + 2 x.
  const Mat4 mirror_x = glm::scale(Mat4(1), {-1, 1, 1});
  CHECK(near(at(mirror_x, target).normal_geometric, {0, 0, 1}, 1e-15));
  CHECK(near(at(mirror_x, target).normal, glm::normalize(normal * Vec3(-1, 1, 1)), 1e-15));
  const Mat4 mirror_z = glm::scale(Mat4(1), {1, 1, -1});
  CHECK(near(at(mirror_z, target).normal_geometric, {0, 0, -1}, 1e-15));
  CHECK(near(at(mirror_z, target).normal, glm::normalize(normal * Vec3(1, 1, -1)), 1e-15));
  Mat4 slope(1);
  slope[0][2] = 2;
  CHECK(near(at(slope, target).normal_geometric, glm::normalize(Vec3(-2, 0, 1)), 1e-15));
  CHECK(near(at(slope, target).normal, glm::normalize(normal - Vec3(2 * normal.z, 0, 0)), 1e-15));

  // Without uv, the hit's weights are its uv. An interpolated normal that faces away is not used.
  mesh.uv.clear();
  mesh.normals = {{1, 0, 0.01}, {-1, 0, 0.01}, {0, 0, -1}};
  Scene scene = test::empty_scene();
  add_instance(scene, add(scene, mesh), add(scene, make_phong({})));
  const reference::Tracer tracer(scene);
  const auto look_at = [&](double x, double y) {
    const Ray ray{{x, y, 1}, {0, 0, -1}};
    return tracer.surface(ray, *tracer.trace(ray));
  };
  CHECK(near(Vec3(look_at(0.5, 0.125).uv, 0), {0.5, 0.125, 0}, 1e-15));
  CHECK(look_at(0.25, 0.5).normal == Vec3(0, 0, 1));
  CHECK(look_at(0.25, 0.0).normal.x > 0.9);
}

TEST_CASE("shadows: a closed mesh weakens light once, an open one by the square root") {
  const Ray ray{{0.1, 0.2, 5}, {0, 0, -1}};
  Scene scene = test::empty_scene();
  const int glass = add(scene, make_dielectric({.shadow = 0.25}));
  const int paint = add(scene, make_phong({}));
  const int box = add(scene, cube());
  add_instance(scene, box, glass);
  const auto light = [&](double t_end) {
    uint32_t flags = 0;
    const double share = reference::Tracer(scene).transmittance(ray, t_end, flags);
    CHECK(reference::Tracer(scene, Acceleration::brute_force).transmittance(ray, t_end, flags) == share);
    return share;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(light(infinity) == 0.25);
  CHECK(light(6) == 0.5);  // the light is in the cube; its far side, at t = 6 exactly, is not before it
  CHECK(light(4) == 1);
  CHECK(light(3) == 1);
  add_instance(scene, box, glass, translation({0, 0, -7}));
  add(scene, make_sphere({0, 0, -20}, 1), glass);
  CHECK(light(infinity) == 0.25 * 0.25 * 0.25);
  CHECK(light(20) == 0.25 * 0.25);
  add_instance(scene, box, paint, translation({0, 0, -50}));
  CHECK(light(infinity) == 0);
  CHECK(light(54) == 0.25 * 0.25 * 0.25);
}

TEST_CASE("media: the eye in a glass mesh, in glass in water, behind a pane of one side") {
  Scene scene = test::empty_scene();
  const int water = add(scene, make_dielectric({.ior = 1.33}));
  const int glass = add(scene, make_dielectric({.ior = 1.5}));
  const int paint = add(scene, make_phong({}));
  const int ball = add(scene, globe(40, 20));
  add_instance(scene, ball, glass, translation({0, -5, 0}));
  add_instance(scene, ball, water, glm::scale(translation({0, -5, 0}), {-3, 3, 2}));
  add_instance(scene, ball, paint, glm::scale(translation({0, -5, 0}), Vec3(9)));
  using Media = std::vector<int>;
  const auto media_at = [&](const Vec3& point) {
    const Media media = reference::media_at(scene, point);
    CHECK(reference::media_at(reference::Tracer(scene), point) == media);
    return media;
  };
  CHECK(media_at({0, -5, 0}) == Media{water, glass});
  CHECK(media_at({0.1, -4.1, 0.2}) == Media{water, glass});
  CHECK(media_at({0, -3.9, 0}) == Media{water});
  CHECK(media_at({2.9, -5, 0}) == Media{water});
  CHECK(media_at({0, -5, 2.9}) == Media{});
  CHECK(media_at({0, 0, 0}) == Media{});
}

TEST_CASE("the media of random globes agree with the globes' equations") {
  Dice dice;
  Scene scene = test::empty_scene();
  std::vector<Mat4> to_globe;
  const int mesh = add(scene, globe(400, 200));
  for (int i = 0; i < 6; ++i) {
    const Mat4 map = random_map(dice, 0.15, 1);
    to_globe.push_back(glm::inverse(map));
    add_instance(scene, mesh, add(scene, make_dielectric({})), map);
  }
  const reference::Tracer tracer(scene);
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 point = dice.in_box(1.5);
    std::vector<int> expected;
    bool certain = true;
    for (int s = 0; s < 6; ++s) {
      const double r = glm::length(Vec3(to_globe[size_t(s)] * Vec4(point, 1)));
      if (r < 1) expected.push_back(s);
      certain = certain && !(r > 0.999 && r < 1);
    }
    if (!certain) continue;
    std::vector<int> found = reference::media_at(tracer, point);
    std::sort(found.begin(), found.end());
    REQUIRE(found == expected);
    inside += !found.empty();
  }
  CHECK(inside > 300);
}

TEST_CASE("a first hit names the coordinates of its t") {
  // t_scale is relative to the eye, and divided by the cosine of incidence.
  Scene scene = one_pixel({1, 0, 5}, {1, 3, 1});
  const int paint = add(scene, make_phong({}));
  const auto t_scale = [&] { return reference::Renderer(scene).first_hit(0, 0).t_scale; };
  CHECK(t_scale() == 0);
  add(scene, make_plane({0, 0, 1}, {0, 0, 1}), paint);
  CHECK(t_scale() == 0);
  add(scene, make_triangle({.vertices = {{{-9, -9, 2}, {21, -9, 2}, {0, 30, 2}}}}), paint);
  CHECK(near(t_scale(), 30 / 0.8, 1e-12));
  Mesh mesh = make_mesh({{-9, -9, 2}, {21, -9, 2}, {0, 30, 2}}, {{0, 1, 2}});
  add_instance(scene, add(scene, mesh), paint, glm::scale(translation({1, 0, 1}), Vec3(1, 2, 1)));
  CHECK(near(t_scale(), (2 * 30 + 4) / 0.8, 1e-12));
}
