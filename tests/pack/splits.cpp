// Spatial splits: the parts of a triangle have separate boxes, and change no hit.
#include <fmt/format.h>

#include <atomic>

#include "host/core/parallel_for.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/query_kernel.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::records;
using namespace eyeray::engine::test;

namespace {

// Long triangles across each other, which a BVH readily splits: needles with a short side of any length, thin
// triangles with all corners far apart, and wide ones.
class LongTriangles {
 public:
  explicit LongTriangles(uint64_t seed) : random_(seed) {
    const double size = coin(0.5) ? 1 : random_.log_uniform(1e-4, 1e4);
    const Vec3 center = coin(0.5) ? Vec3(0) : random_.direction() * size * random_.log_uniform(1, 1e3);
    scene_.camera.eye = coin(0.5) ? Vec3(0) : center + random_.point(2) * size;
    scene_.camera.target = scene_.camera.eye + Vec3(0, 0, -1);
    add(scene_, make_phong({}));
    Mesh mesh;
    const Vec3 along = random_.direction() * size;
    const double bundle = coin(0.7) ? 1 : 0;  // share of needles that run alike
    for (const int end = 60 + random_.below(100); int(mesh.triangles.size()) < end;) {
      Corners v;
      for (Vec3& corner : v) corner = center + random_.point(1) * size;
      const double thin = random_.log_uniform(1e-8, 1e-1);
      const int kind = random_.below(4);
      if (coin(bundle)) v[1] = v[0] + along * random_.uniform(0.5, 2) + random_.point(size) * 0.01;
      if (coin(bundle)) v[2] = glm::mix(v[0], v[1], random_.uniform()) + random_.point(size) * 0.01;
      if (kind == 0) v[2] = v[1] + random_.point(size) * thin;
      if (kind == 1) v[2] = glm::mix(v[0], v[1], random_.uniform()) + random_.point(size) * thin;
      if (!(thickness(v) >= thinnest_triangle)) continue;
      const auto first = uint32_t(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), v.begin(), v.end());
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    const int index = add(scene_, std::move(mesh));
    // A mesh that is shown twice becomes instances; one that is shown once is baked into the world.
    const bool twice = coin(0.2);
    add_instance(scene_, index, 0, Mat4(1.0));
    if (twice)
      add_instance(scene_, index, 0,
                   translation(center) * glm::rotate(Mat4(1.0), random_.uniform(0, 7), random_.direction()) *
                       translation(-center));
    size_ = size;
    const PackedScene packed = pack::pack(scene_, {.acceleration = Acceleration::brute_force});
    for (const shader::Primitive& p : packed.primitives) corners_.push_back({p.a, p.b, p.c});
  }

  Scene& scene() { return scene_; }

  // Rays at triangles. Most lie in the triangle's plane, except for the rounding of their numbers.
  std::vector<shader::QueryRay> rays(size_t count) {
    std::vector<shader::QueryRay> rays(count);
    for (shader::QueryRay& ray : rays) {
      const auto& triangle = corners_[size_t(random_.below(int(corners_.size())))];
      const Vec3 a(triangle[0]), b(triangle[1]), c(triangle[2]);
      const auto in_plane = [&](double reach) {
        return a + (b - a) * random_.uniform(-reach, 1 + reach) +
               (c - a) * random_.uniform(-reach, 1 + reach);
      };
      const Vec3 to = random_.below(3) == 0 ? glm::mix(a, b, random_.uniform()) : in_plane(0);
      Vec3 from = in_plane(2);
      if (coin(0.1)) from = to + random_.direction() * size_ * random_.log_uniform(1e-2, 1e3);
      if (coin(0.1)) from = to + (Vec3(b) - Vec3(c)) * random_.uniform(-3, 3);
      if (coin(0.2)) from += random_.direction() * size_ * random_.log_uniform(1e-9, 1e-2);
      if (from == to) from += Vec3(0, 0, size_);
      const Vec3 direction = glm::normalize(to - from);
      ray = query_ray(from, direction, coin(0.5) ? 3e38 : glm::length(to - from));
    }
    return rays;
  }

 private:
  bool coin(double share) { return random_.uniform() < share; }

  Random random_;
  Scene scene_ = test::empty_scene();
  double size_ = 1;
  std::vector<std::array<glm::vec3, 3>> corners_;
};

}  // namespace

TEST_CASE("4 million grazing rays at split triangles hit the same by BVH and brute force, to the last bit" *
          doctest::test_suite("long")) {
  std::atomic<int64_t> compared = 0, hits = 0, different = 0, parts = 0, triangles = 0;
  parallel_for(0, 500, [&](int seed) {
    LongTriangles hard{uint64_t(seed)};
    const PackedScene brute = pack::pack(hard.scene(), {.acceleration = Acceleration::brute_force});
    const PackedScene cut = pack::pack(hard.scene(), {.acceleration = Acceleration::bvh, .split = true});
    triangles += int64_t(brute.primitives.size());
    parts += int64_t(cut.primitives.size());
    const std::vector<shader::QueryRay> rays = hard.rays(4000);
    for (const bool any : {false, true}) {
      const std::vector<shader::QueryHit> expected = query_twin(brute, rays, any);
      for (const shader::QueryHit& hit : expected) hits += hit.primitive != NONE || hit.occlusion > 0;
      compared += int64_t(rays.size());
      different += differences(expected, query_twin(cut, rays, any));
    }
  });
  MESSAGE(fmt::format("{} compared, {} hit, {} triangles in {} parts: {} differ", compared.load(),
                      hits.load(), triangles.load(), parts.load(), different.load()));
  CHECK(compared == 4'000'000);
  CHECK(hits > 900'000);
  CHECK(parts > triangles * 11 / 10);
  CHECK(different == 0);
}

TEST_CASE("CSG objects with a transmitting part are not split: in two leaves they would count twice") {
  LongTriangles hard{1};
  const auto primitives = [&](bool split) {
    return pack::pack(hard.scene(), {.acceleration = Acceleration::bvh, .split = split}).primitives.size();
  };
  REQUIRE(primitives(true) > primitives(false));
  shapes::ShapeType::Shapes lens;
  for (const bool glass : {true, false}) {
    lens.push_back(make_sphere(hard.scene().camera.eye + Vec3(glass, 0, 0), 2));
    lens.back()->material = glass ? add(hard.scene(), make_dielectric({.shadow = 0.7})) : 0;
  }
  add(hard.scene(), make_csg(true, std::move(lens)), 0);
  CHECK(primitives(true) == primitives(false));
}
