// CSG objects against numbers worked out by hand.
#include <fmt/format.h>

#include <numbers>

#include "host/formula/formula.hpp"
#include "host/reference/media.hpp"
#include "host/shapes/registry.hpp"
#include "host/shapes/spans.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::test;

namespace {

shapes::ShapeType::Shapes operands(std::unique_ptr<Shape> a, std::unique_ptr<Shape> b = nullptr) {
  shapes::ShapeType::Shapes list;
  list.push_back(std::move(a));
  if (b) list.push_back(std::move(b));
  return list;
}

std::unique_ptr<Shape> made_of(std::unique_ptr<Shape> shape, int material) {
  shape->material = material;
  return shape;
}

// The spans of the ray's line within the shape, as "in out in out".
std::vector<double> ends(const Shape& shape, const Ray& ray) {
  std::vector<double> all;
  for (const auto& [in, out] : shape.spans(ray)) {
    all.push_back(in.t);
    all.push_back(out.t);
  }
  return all;
}

// Spans of a ray along x, given as pairs of distances.
std::vector<Span> spans(std::initializer_list<std::pair<double, double>> list, uint32_t part) {
  std::vector<Span> all;
  for (const auto& [in, out] : list) all.push_back({{in, 0, 0, part}, {out, 0, 0, part}});
  return all;
}
std::string text(const std::vector<Span>& spans) {
  std::string all;
  for (const auto& [in, out] : spans)
    all += fmt::format("{}{:g}-{}{:g} ", char('a' + in.part), in.t, char('a' + out.part), out.t);
  return all;
}

const Ray along_x{{-10, 0, 0}, {1, 0, 0}};

}  // namespace

TEST_CASE("intervals of a line are united, intersected and subtracted") {
  const auto a = spans({{0, 2}, {4, 6}, {8, 9}}, 0);
  const auto b = spans({{1, 5}, {6, 7}}, 1);
  CHECK(text(unite(a, b)) == "a0-b7 a8-a9 ");
  CHECK(text(shapes::intersect(a, b)) == "b1-a2 a4-b5 ");
  CHECK(text(subtract(a, b)) == "a0-b1 b5-a6 a8-a9 ");
  CHECK(text(subtract(b, a)) == "a2-a4 a6-b7 ");
  CHECK(text(subtract(b, spans({{2, 3}, {4, 4.5}}, 2))) == "b1-c2 c3-c4 c4.5-b5 b6-b7 ");
  CHECK(text(unite({}, b)) == text(b));
  CHECK(text(shapes::intersect({}, b)).empty());
}

TEST_CASE("of two coincident parts the lower one is hit, and no interval of length zero is left") {
  const auto a = spans({{0, 2}}, 0);
  CHECK(text(unite(a, spans({{0, 2}}, 1))) == "a0-a2 ");
  CHECK(text(unite(spans({{0, 2}}, 1), a)) == "a0-a2 ");
  CHECK(text(unite(a, spans({{2, 3}}, 1))) == "a0-b3 ");
  CHECK(text(shapes::intersect(spans({{0, 2}}, 1), a)) == "a0-a2 ");
  CHECK(text(shapes::intersect(a, spans({{2, 3}}, 1))).empty());
  CHECK(text(subtract(a, spans({{0, 2}}, 1))).empty());
  CHECK(text(subtract(a, spans({{0, 1}}, 1))) == "b1-a2 ");
  CHECK(text(subtract(a, spans({{1, 2}}, 1))) == "a0-b1 ");
  CHECK(text(subtract(a, spans({{2, 3}}, 1))) == "a0-a2 ");
}

TEST_CASE("a lens is entered through one ball and left through the other, with outward normals") {
  const auto lens = make_csg(true, operands(make_sphere({-1, 0, 0}, 2), make_sphere({1, 0, 0}, 2)));
  CHECK(ends(*lens, along_x) == std::vector<double>{9, 11});
  const SurfacePoint front = surface_hit(*lens, along_x);
  CHECK(near(front.position, Vec3(-1, 0, 0), 1e-14));
  CHECK(near(front.normal, Vec3(-1, 0, 0), 1e-14));
  CHECK(near(surface_hit(*lens, {{0, 0, 0}, {1, 0, 0}}).normal, Vec3(1, 0, 0), 1e-14));
  // The lens's rim lies on both balls, at a distance of √3 from the axis.
  CHECK(distance(*lens, {{0, 1.733, -10}, {0, 0, 1}}) == -1);
  CHECK(near(distance(*lens, {{0, 0, -10}, {0, 0, 1}}), 10 - std::sqrt(3.0), 1e-13));
  CHECK(lens->bounds().min.x == -1);
  CHECK(lens->bounds().max.x == 1);
}

TEST_CASE("a subtracted shape shows its surface from within, in its own material") {
  const auto box = make_csg(false, operands(made_of(make_box(Vec3(-1), Vec3(1)), 3)),
                            operands(made_of(make_sphere({-1, 0, 0}, 0.5), 5)));
  CHECK(ends(*box, along_x) == std::vector<double>{9.5, 11});
  const auto hit = box->intersect(along_x);
  REQUIRE(hit);
  CHECK(box->part(*hit).material == 5);
  const SurfacePoint hollow = box->surface(along_x, *hit);
  CHECK(near(hollow.position, Vec3(-0.5, 0, 0), 1e-14));
  CHECK(near(hollow.normal, Vec3(-1, 0, 0), 1e-14));
  CHECK(near(hollow.normal_geometric, Vec3(-1, 0, 0), 1e-14));
  const Ray beside{{-10, 0.6, 0}, {1, 0, 0}};
  CHECK(box->part(*box->intersect(beside)).material == 3);
  CHECK(near(distance(*box, beside), 9, 1e-14));
}

TEST_CASE("a tube is crossed four times; CSG objects contain CSG objects, subtracted ones too") {
  const auto tube = [] {
    return make_csg(false, operands(make_cylinder({0, -1, 0}, {0, 1, 0}, 2)),
                    operands(make_cylinder({0, -2, 0}, {0, 2, 0}, 1)));
  };
  CHECK(ends(*tube(), along_x) == std::vector<double>{8, 9, 11, 12});
  // The tube within a box, and a box without the tube.
  const auto kept = make_csg(true, operands(tube(), make_box({-5, -5, -5}, {0, 5, 5})));
  CHECK(ends(*kept, along_x) == std::vector<double>{8, 9});
  const auto cut = make_csg(false, operands(make_box({-5, -0.5, -5}, {5, 0.5, 5})), operands(tube()));
  CHECK(ends(*cut, along_x) == std::vector<double>{5, 8, 9, 11, 12, 15});
  // The hole is cut out of the tube, and the tube out of the box: so the hole is solid again.
  CHECK(near(surface_hit(*cut, {{0, 0, 0}, {1, 0, 0}}).normal, Vec3(1, 0, 0), 1e-14));
}

TEST_CASE("each closed shape returns the intervals of a line within it, whichever way the line is given") {
  CHECK(ends(*make_torus({0, 0, 0}, {0, 1, 0}, 3, 1), along_x).size() == 4);
  const auto half = make_hyperboloid({0, -1, 0}, {0, 1, 0}, 1, 1, 0.5);
  CHECK(ends(*half, {{0.7, -5, 0}, {0, 1, 0}}).size() == 4);
  CHECK(!make_cylinder({0, 0, 0}, {0, 1, 0}, 1, true)->is_closed());
  CHECK(!make_disk({0, 0, 0}, {0, 1, 0}, 1)->is_closed());
  CHECK(!make_plane({0, 0, 0}, {0, 1, 0})->is_closed());
  CHECK(make_cone({0, 0, 0}, {0, 1, 0}, 1)->is_closed());
  CHECK(make_paraboloid({0, 0, 0}, {0, 1, 0}, 1)->is_closed());
}

TEST_CASE("formula solids: each crossing counts once, alternating, with a Lipschitz constant and without") {
  // Sheets whose faces the ray crosses in pairs. The box's faces bound a sheet in which the box begins or
  // ends.
  const auto sheets = [](double lipschitz) {
    FormulaUse use{
        std::make_shared<const formula::Formula>(
            formula::FormulaText{"float f(vec3 p) { return cos(6.283185307179586 * p.x) - 0.5; }", {}},
            std::vector<formula::FormulaParameter>{}, "sheets"),
        {Vec3(-1.5, -1, -1), Vec3(1, 1, 1)},
        lipschitz};
    return make_implicit(std::move(use), false);
  };
  const float turn = 6.283185307179586f;  // as the formula has it
  const double sixth = std::numbers::pi / 3 / double(turn);
  for (const double lipschitz : {6.3, 0.0}) {
    CAPTURE(lipschitz);
    const std::vector<double> found = ends(*sheets(lipschitz), along_x);
    const std::vector<double> expected{8.5,        10 - 7 * sixth, 10 - 5 * sixth,
                                       10 - sixth, 10 + sixth,     10 + 5 * sixth};
    REQUIRE(found.size() == expected.size());
    for (size_t i = 0; i < found.size(); ++i) CHECK(near(found[i], expected[i], 1e-12));
    // The sheets less a ball, whose surface is seen where the ball cuts a sheet.
    const auto cut = make_csg(false, operands(sheets(lipschitz)), operands(make_sphere({-0.3, 0, 0}, 0.3)));
    const std::vector<double> left = ends(*cut, along_x);
    REQUIRE(left.size() == 6);
    CHECK(near(left[2], 10 - 5 * sixth, 1e-12));
    CHECK(near(left[3], 9.4, 1e-12));
    CHECK(near(surface_hit(*cut, {{0, 0, 0}, {-1, 0, 0}}).normal, Vec3(1, 0, 0), 1e-9));
  }
}

TEST_CASE("shadows: a CSG object counts once, by its densest surface on the ray") {
  Scene scene = test::empty_scene();
  add(scene, make_phong({}));
  add(scene, make_dielectric({.ior = 1.5, .shadow = 0.8}));
  add(scene,
      make_csg(false, operands(made_of(make_box(Vec3(-1), Vec3(1)), 1)),
               operands(made_of(make_sphere({0, 1, 0}, 0.5), 0))),
      1);
  const reference::Tracer tracer(scene);
  const Ray above{{-10, 0.9, 0}, {1, 0, 0}};
  uint32_t flags = 0;
  CHECK(tracer.transmittance(along_x, 100, flags) == doctest::Approx(0.8));
  CHECK(tracer.transmittance(along_x, 8.9, flags) == 1);
  CHECK(tracer.transmittance(above, 100, flags) == 0);
  CHECK(tracer.transmittance(above, 9.2, flags) == doctest::Approx(0.8));
  CHECK(flags == 0);
}

TEST_CASE("the eye is in the medium of a glass CSG object, but in none within a subtracted part") {
  Scene scene = test::empty_scene();
  add(scene, make_dielectric({.ior = 1.5}));
  add(scene, make_csg(false, operands(make_box(Vec3(-1), Vec3(1))), operands(make_sphere({0, 0, 0}, 0.5))),
      0);
  CHECK(reference::media_at(scene, {0.7, 0.1, 0}) == std::vector<int>{0});
  CHECK(reference::media_at(scene, {0.1, 0.1, 0}).empty());
  CHECK(reference::media_at(scene, {3, 0, 0}).empty());
}
