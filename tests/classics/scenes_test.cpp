// Tests the databases against their descriptions: counts, positions, heights, and the pixels that show
// certain points.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "classics.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/support/pixel.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::classics;
using eyeray::engine::test::pixel;

namespace {

Scene scene_of(const Classic& classic, int size_factor) {
  return parse_scene(classic.scene(size_factor), std::string(classic.name));
}

// Checks that a point projects to the expected position in the picture, within a hundredth of a pixel.
void check_pixel(const Scene& scene, const Vec3& point, const Vec2& expected) {
  CAPTURE(point.x);
  const Vec2 p = pixel(scene, point);
  CHECK(std::abs(p.x - expected.x) < 0.01);
  CHECK(std::abs(p.y - expected.y) < 0.01);
}

Vec3 face_normal(const Mesh& mesh, const std::array<uint32_t, 3>& t) {
  const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
  return glm::cross(b - a, c - b);
}

}  // namespace

TEST_CASE("the mesh's vertices lie on the teapot's 32 patches: corners and midpoints of edges") {
  const Scene scene = parse_scene(teapot_classic.scene(1) + teapot_bezier(), "teapot");
  CHECK(scene.shapes.size() == 2 + 32);
  const Mesh mesh = teapot_classic.mesh(2);
  // A ray from outside, along the normal at each vertex of the mesh, hits the Bézier patches at that vertex.
  int met = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Ray ray{mesh.positions[i] + mesh.normals[i] * 0.01, -mesh.normals[i]};
    double nearest = HUGE_VAL;
    for (const auto& shape : scene.shapes)
      if (const auto hit = shape->intersect(ray)) nearest = std::min(nearest, hit->t);
    met += std::abs(nearest - 0.01) < 1e-6;
  }
  CHECK(met == int(mesh.positions.size()));
}

TEST_CASE("every classic is a scene without warnings, at its smallest and at its published size") {
  for (const Classic& classic : all_classics()) {
    CAPTURE(classic.name);
    for (const int size_factor : {1, 2, classic.size_factor}) {
      const Scene scene = scene_of(classic, size_factor);
      CHECK(scene.shapes.size() == classic.shapes(size_factor));
      CHECK(scene.image.width == 512);
      CHECK(scene.image.height == 512);
      CHECK(test::camera_as<PerspectiveCamera>(scene).fov_degrees ==
            doctest::Approx(45.0792615).epsilon(1e-9));
      if (!classic.mesh) CHECK(scene.warnings.empty());
    }
  }
}

TEST_CASE("tetra has 4^n triangles that face outward") {
  for (const auto& [size_factor, count] : std::map<int, size_t>{{1, 4}, {2, 16}, {3, 64}, {6, 4096}}) {
    const Mesh mesh = tetra_classic.mesh(size_factor);
    CHECK(mesh.triangles.size() == count);
    CHECK(mesh.normals.empty());
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      Vec3 middle(0.0);
      for (size_t k = 0; k < 4; ++k) middle += mesh.positions[i / 4 * 4 + k] / 4.0;
      CHECK(glm::dot(face_normal(mesh, mesh.triangles[i]), mesh.positions[mesh.triangles[i][0]] - middle) >
            0);
    }
  }
  const Mesh mesh = tetra_classic.mesh(6);
  CHECK(mesh.positions.front() == Vec3(-1, -1, 1));  // depth first, the first corner's copy first
  CHECK(mesh.positions.back() == Vec3(1, 1, 1));
  const Scene scene = scene_of(tetra_classic, 1);
  check_pixel(scene, {-1, 1, -1}, {19.87, 356.25});
  check_pixel(scene, {1, 1, 1}, {384.20, 345.93});
}

TEST_CASE("tree has 2^(n+1) - 1 branches, each shorter and thinner than its parent") {
  for (const auto& [size_factor, count] : std::map<int, size_t>{{1, 3}, {2, 7}, {3, 15}, {11, 4095}}) {
    std::vector<Branch> all;
    for_each_branch(size_factor, [&](const Branch& branch) { all.push_back(branch); });
    CHECK(all.size() == count);
    std::set<std::array<double, 3>> tips;
    for (const Branch& branch : all) {
      CHECK(branch.tip_radius == doctest::Approx(0.67 * branch.radius));
      tips.insert({branch.tip.x, branch.tip.y, branch.tip.z});
    }
    for (size_t i = 1; i < all.size(); ++i)
      CHECK(tips.contains({all[i].foot.x, all[i].foot.y, all[i].foot.z}));
  }
  std::vector<Branch> all;
  for_each_branch(3, [&](const Branch& branch) { all.push_back(branch); });
  CHECK(all[0].foot == Vec3(0.0));
  CHECK(all[0].tip == Vec3(0, 0, 1));
  CHECK(all[0].radius == 0.15);
  // The first child leans by 40° towards its y axis, which the turn by 90° has taken to −x.
  CHECK(glm::distance(all[1].tip, Vec3(0.65 * 0.6427876096865394, 0, 1 + 0.65 * 0.766044443118978)) < 1e-15);
  CHECK(glm::distance(all[8].tip, {-0.226621, 0.190158, 1.634415}) < 1e-6);
  CHECK(all[8].radius == doctest::Approx(0.15 * 0.67));

  const Scene scene = scene_of(tree_classic, 1);
  CHECK(scene.lights.size() == 7);
  check_pixel(scene, {0, 0, 1}, {256.00, 322.64});
  check_pixel(scene, {-0.226621, 0.190158, 1.634415}, {283.27, 235.62});
}

TEST_CASE("rings has 5n(n+1)(2n+1) rods, in closed rings of five") {
  for (const auto& [size_factor, count] : std::map<int, size_t>{{1, 30}, {2, 150}, {3, 420}, {7, 4200}}) {
    std::vector<Rod> all;
    for_each_rod(size_factor, [&](const Rod& rod) { all.push_back(rod); });
    CHECK(all.size() == count);
    for (size_t i = 0; i < all.size(); ++i) {
      CHECK(all[i].ring == int(i / 5 % 6));
      const Rod& before = all[i / 5 * 5 + (i + 4) % 5];
      CHECK(glm::distance(all[i].to, before.from) < 1e-14);
      CHECK(glm::distance(all[i].from, all[i].to) ==
            doctest::Approx(2 * std::sin(M_PI / 5) / (1 + rod_radius)).epsilon(1e-14));
    }
  }
  // The first ring stands in the middle of the first layer; the points of the last layer's far corner are
  // known.
  std::vector<Rod> all;
  for_each_rod(7, [&](const Rod& rod) { all.push_back(rod); });
  CHECK(glm::distance(all[0].from, Vec3(1 / (1 + rod_radius), 2.613125929752753, 0)) < 1e-14);
  // Ring 1 is ring 0, tilted by atan 2 and turned by 36°.
  const Vec3 tilted =
      Vec3(0.3090169943749474, 0.9510565162951535 / std::sqrt(5), 2 * 0.9510565162951535 / std::sqrt(5));
  const double c = 0.8090169943749475, s = 0.5877852522924731;
  CHECK(glm::distance(all[6].from - Vec3(0, 2.613125929752753, 0),
                      Vec3(c * tilted.x - s * tilted.y, s * tilted.x + c * tilted.y, tilted.z) /
                          (1 + rod_radius)) < 1e-14);

  const Scene scene = scene_of(rings_classic, 7);
  check_pixel(scene, {0, 2.613126, 0}, {374.03, 315.01});
  check_pixel(scene, {-6, 18.291882, 6}, {108.47, 93.71});
}

TEST_CASE("gears has n^3 gears, whose sides join top and bottom to the last bit") {
  for (const auto& [size_factor, count, glass] : {std::array{1, 1, 1}, {2, 8, 2}, {3, 27, 6}, {4, 64, 13}}) {
    std::vector<Gear> all;
    for_each_gear(size_factor, [&](const Gear& gear) { all.push_back(gear); });
    CHECK(all.size() == size_t(count));
    CHECK(std::ranges::count_if(all, &Gear::glass) == glass);
    for (const Gear& gear : all) {
      std::set<std::array<double, 2>> top, bottom;
      double twice_area = 0;
      for (size_t i = 0; i < 144; ++i) {
        const Vec3 &a = gear.top[i], &b = gear.top[(i + 1) % 144], &c = gear.bottom[i];
        top.insert({a.x, a.y});
        bottom.insert({c.x, c.y});
        twice_area +=
            (a.x - gear.center.x) * (b.y - gear.center.y) - (b.x - gear.center.x) * (a.y - gear.center.y);
        CHECK(a.z == gear.center.z);
        CHECK(c.z == gear.center.z - gear.thickness);
        CHECK(glm::length(Vec2(a - gear.center)) == doctest::Approx((i % 4 < 2 ? 0.995 : 0.9) * gear.radius));
      }
      CHECK(top.size() == 144);
      CHECK(top == bottom);
      CHECK(twice_area / 2 > 0.81 * 3.1 * gear.radius * gear.radius);  // counter-clockwise
      CHECK(twice_area / 2 < 0.99 * 3.1 * gear.radius * gear.radius);
      // The corners from which its normals are made are convex.
      CHECK(glm::cross(gear.top[1] - gear.top[0], gear.top[2] - gear.top[1]).z > 0);
      CHECK(glm::cross(gear.bottom[1] - gear.bottom[0], gear.bottom[2] - gear.bottom[1]).z < 0);
      CHECK(std::max({gear.color.x, gear.color.y, gear.color.z}) == 1);
    }
  }
  std::vector<Gear> all;
  for_each_gear(4, [&](const Gear& gear) { all.push_back(gear); });
  CHECK(all[0].glass);
  CHECK(all[1].color == Vec3(1));
  const Scene scene = scene_of(gears_classic, 4);
  check_pixel(scene, all[0].center, {164.56, 274.92});
  check_pixel(scene, all[1].center, {290.08, 227.46});
}

TEST_CASE("mount's random numbers and heights are the package's") {
  CHECK(mount_gauss(21) == doctest::Approx(-0.190909456).epsilon(1e-8));
  CHECK(mount_gauss(100) == doctest::Approx(-0.582944767).epsilon(1e-8));
  CHECK(mount_gauss(65556) == doctest::Approx(0.530489757).epsilon(1e-8));
  for (uint32_t seed = 21; seed < 21 + 65536; ++seed) CHECK(std::abs(mount_gauss(seed)) < 6);  // no NaN

  const std::map<std::pair<int, int>, uint32_t> seeds = {{{32, 0}, 85},     {{64, 32}, 16533},
                                                         {{32, 64}, 32853}, {{0, 32}, 16405},
                                                         {{32, 32}, 16469}, {{63, 63}, 32403}};
  for (const auto& [at, seed] : seeds) CHECK(mount_seed(6, at.first, at.second) == seed);

  const std::vector<double> heights = mount_heights(6);
  const auto at = [&](size_t i, size_t j) { return heights[j * 65 + i]; };
  CHECK(std::abs(at(32, 32) - 0.5295507072) < 1e-10);
  CHECK(std::abs(at(16, 16) - 0.3436389489) < 1e-10);
  CHECK(std::abs(at(1, 0) + 0.0160409387) < 1e-10);
  CHECK(std::abs(at(63, 63) - 0.0027787144) < 1e-10);
  CHECK(at(0, 0) == 0);
  CHECK(at(64, 64) == 0);
  CHECK(std::abs(*std::ranges::min_element(heights) + 0.7029532627) < 1e-10);
  CHECK(std::abs(*std::ranges::max_element(heights) - 0.9231396182) < 1e-10);
}

TEST_CASE("mount has 2 * 4^n triangles that face up, and four balls") {
  for (const auto& [size_factor, count] : std::map<int, size_t>{{1, 8}, {2, 32}, {3, 128}, {6, 8192}}) {
    const Mesh mesh = mount_classic.mesh(size_factor);
    CHECK(mesh.triangles.size() == count);
    double area = 0;
    bool up = true;
    for (const auto& triangle : mesh.triangles) {
      const double twice = face_normal(mesh, triangle).z;
      up &= twice > 0;
      area += twice / 2;
    }
    CHECK(up);
    CHECK(area == doctest::Approx(4));
  }
  // Triangles come quarter by quarter, recursively.
  const Mesh mesh = mount_classic.mesh(2);
  CHECK(mesh.triangles[0] == std::array<uint32_t, 3>{0, 1, 6});
  CHECK(mesh.triangles[1] == std::array<uint32_t, 3>{6, 5, 0});
  CHECK(mesh.triangles[4] == std::array<uint32_t, 3>{6, 7, 12});
  CHECK(mesh.triangles[6] == std::array<uint32_t, 3>{5, 6, 11});
  CHECK(mesh.triangles[8] == std::array<uint32_t, 3>{2, 3, 8});
  CHECK(mesh.triangles[16] == std::array<uint32_t, 3>{12, 13, 18});

  const Scene scene = scene_of(mount_classic, 6);
  check_pixel(scene, {1, 0, 0.657244}, {110.65, 60.68});
  check_pixel(scene, {-1, 0, -0.314742}, {433.74, 426.02});
  // The balls touch each other.
  std::vector<Vec3> centers;
  for (const auto& shape : scene.shapes) centers.push_back((shape->bounds().min + shape->bounds().max) / 2.0);
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < i; ++j)
      CHECK(glm::distance(centers[i], centers[j]) == doctest::Approx(0.34).epsilon(1e-12));
  }
}

TEST_CASE("teapot has 64n^2 - 8n triangles; from n = 6 on, all normals are on their side") {
  for (const auto& [size_factor, count] :
       std::map<int, size_t>{{1, 56}, {2, 240}, {3, 552}, {4, 992}, {5, 1560}, {6, 2256}, {12, 9120}}) {
    const Mesh mesh = teapot_classic.mesh(size_factor);
    CHECK(mesh.triangles.size() == count);
    const int factor = size_factor;
    CAPTURE(factor);
    size_t inward = 0, empty = 0;
    for (const auto& triangle : mesh.triangles) {
      const Vec3 n = face_normal(mesh, triangle);
      empty += n == Vec3(0.0);
      for (const uint32_t corner : triangle) inward += glm::dot(mesh.normals[corner], n) <= 0;
    }
    CHECK(empty == (size_factor == 1 ? 4 : 0));  // the spout's end is flat at that factor
    CHECK((inward > 0) == (size_factor < 6));    // coarse patches turn by more than a right angle
    for (const Vec3& n : mesh.normals) CHECK(glm::length(n) == doctest::Approx(1).epsilon(1e-12));
  }
  const std::vector<BezierPatch> patches = teapot_patches();
  REQUIRE(patches.size() == 32);
  CHECK(patches[0][1][2] == Vec3(0.56 * 1.3375, -1.3375, 2.53125));
  CHECK(patches[16][0] ==
        std::array<Vec3, 4>{{{1.7, 0, 1.425}, {1.7, -0.66, 1.425}, {1.7, -0.66, 0.6}, {1.7, 0, 0.6}}});
  CHECK(glm::distance(patches[20][1][1], Vec3(0.8, -0.45, 3.15)) <
        1e-15);  // here Newell's own bulge, not 0.56
  CHECK(patches[21][1][0] == Vec3(0, -0.8, 3.15));
  CHECK(patches[29][3][0] == Vec3(0, 1.5, 0.15));

  // Spout and handle, rim and cusps are where the tables have them.
  const Mesh mesh = teapot_classic.mesh(6);
  Bounds box;
  for (const Vec3& p : mesh.positions) box.include(p);
  CHECK(box.min.x == doctest::Approx(-3));
  CHECK(box.max.z == doctest::Approx(3.15));
  CHECK(box.min.z == 0);
  const Scene scene = scene_of(teapot_classic, 12);
  check_pixel(scene, {3.2, 0, 2.4}, {36.13, 165.39});
  check_pixel(scene, {-3, 0, 1.8}, {399.30, 116.84});
}

TEST_CASE("every classic passes verify without warnings" * doctest::test_suite("long")) {
  const std::map<std::string_view, int> size_factors = {{"tetra", 3}, {"tree", 3},  {"rings", 1},
                                                        {"gears", 1}, {"mount", 3}, {"teapot", 6}};
  for (const Classic& classic : all_classics()) {
    CAPTURE(classic.name);
    const test::TemporaryFolder folder;
    write(classic, size_factors.at(classic.name), folder.path());
    const ProcessResult verified =
        test::run_eyeray({"verify", folder / "scene.toml", "-s", "64x64", "--quiet"});
    CHECK(verified.err == "");
    CHECK(verified.code == 0);
  }
}
