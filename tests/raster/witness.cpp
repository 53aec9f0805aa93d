// Gate R on whole scenes: honest first hits pass, and damaged ones do not.
#include "host/raster/witness.hpp"

#include <functional>
#include <glm/ext/matrix_transform.hpp>

#include "host/executors/executor.hpp"
#include "host/loader/scene_file.hpp"
#include "host/materials/make.hpp"
#include "host/shapes/make.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/meshes.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::raster;

namespace {

constexpr Rect all{0, 0, 96, 72};

Scene load(const std::string& name) {
  Scene scene = loader::load_scene("scenes/" + name);
  scene.image.width = all.width;
  scene.image.height = all.height;
  return scene;
}

compare::Frame traced(const Scene& scene, const Rect& area = all) {
  compare::Frame frame;
  frame.area = area;
  frame.first_hits.resize(size_t(area.pixels()));
  executors::make_executor(executors::Backend::reference, scene, {})->first_hits(area, frame.first_hits);
  return frame;
}

struct Compared {
  Scene scene;
  Witness witness{scene, all, {.validation = "core"}};
  compare::Frame frame = traced(scene);

  explicit Compared(Scene made) : scene(std::move(made)) {}
  // The result of gate R after damage to each hit.
  compare::RasterResult with(const std::function<void(FirstHit&)>& damage) const {
    compare::Frame damaged = frame;
    for (FirstHit& hit : damaged.first_hits) damage(hit);
    return witness.compare(damaged, "damaged");
  }
};

// One-sided squares before a wall, each over a quarter of the picture. The upper two face the viewer; the
// upper left and the lower right ones are mirrored.
Scene one_sided_squares() {
  Scene scene = test::empty_scene();
  scene.camera.eye = Vec3(0, 0, 8);
  scene.image.width = all.width;
  scene.image.height = all.height;
  const int front = test::add(scene, materials::make_phong({})),
            behind = test::add(scene, materials::make_phong({}));
  scene.materials[size_t(front)]->front_only = true;
  shapes::TriangleValues wall;
  wall.vertices = {Vec3(-90, -90, -2), Vec3(90, -90, -2), Vec3(0, 90, -2)};
  test::add(scene, shapes::make_triangle(wall), behind);
  for (const auto& [x, y] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}}) {
    std::vector<std::array<uint32_t, 3>> corners{{0, 1, 2}, {0, 2, 3}};
    if (y < 0) corners = {{2, 1, 0}, {3, 2, 0}};
    const int mesh = test::add(
        scene, test::make_mesh({Vec3(0, 0, 0), Vec3(20, 0, 0), Vec3(20, 20, 0), Vec3(0, 20, 0)}, corners));
    test::add_instance(scene, mesh, front, glm::scale(Mat4(1.0), Vec3(x, y, 1)));
  }
  return scene;
}

}  // namespace

TEST_CASE("the reference's rays hit the rasterised triangles: of a mesh, in a crop, in parallel projection") {
  for (const char* name : {"meshes.toml", "orthographic.toml", "shapes/prism.toml"}) {
    CAPTURE(name);
    const Compared compared{load(name)};
    const compare::RasterResult honest = compared.with([](FirstHit&) {});
    CHECK(honest.passes());
    CHECK(honest.pixels == all.pixels());
    CHECK(double(honest.equal) >= 0.999 * double(honest.pixels));
    CHECK(honest.equal + honest.explained_pixels() + honest.hidden == honest.pixels);
  }
  const Scene scene = load("meshes.toml");
  const Rect crop{30, 20, 17, 11};
  const Witness witness(scene, crop, {.validation = "sync"});
  CHECK(witness.compare(traced(scene, crop), "part").passes());
}

TEST_CASE("one-sided meshes are drawn from their front alone, mirrored ones too") {
  const Compared compared{one_sided_squares()};
  CHECK(compared.with([](FirstHit&) {}).passes());
  const auto hit_in = [&](size_t row) { return compared.frame.first_hits[96 * row + 20].primitive; };
  CHECK(hit_in(10) > 0);
  CHECK(hit_in(60) == 0);
}

TEST_CASE("a neighbour's id, another t, another position, a miss and a ghost are each found") {
  const Compared compared{load("meshes.toml")};
  const auto fails = [&](const std::function<void(FirstHit&)>& damage, const char* reason) {
    CAPTURE(reason);
    const compare::RasterResult result = compared.with(damage);
    CHECK_FALSE(result.passes());
    CHECK(result.difference.find(reason) != std::string::npos);
    return result.unexplained;
  };
  CHECK(fails([](FirstHit& hit) { hit.primitive ^= hit.primitive >= 0 ? 1 : 0; },
              "the ray hits a primitive that") > 5000);
  fails([](FirstHit& hit) { hit.t *= 1.0001; }, "its position falls");
  fails([](FirstHit& hit) { hit.position.x += 1e-3; }, "its position falls");
  fails([](FirstHit& hit) { hit.position = Vec3(std::nan("")); }, "not a number");
  fails(
      [](FirstHit& hit) {
        if (hit.primitive == 0) hit = {};
      },
      "the ray hits a primitive that cannot be there");
  fails(
      [](FirstHit& hit) {
        if (hit.primitive > 0) hit.primitive = 1 << 30;
      },
      "the ray hits a primitive that");
  // Damages both t and the position, along the ray.
  const Vec3 eye = compared.scene.camera.eye;
  fails(
      [&](FirstHit& hit) {
        hit.t *= 1.0001;
        hit.position = eye + (hit.position - eye) * 1.0001;
      },
      "the ray hits a primitive that cannot be there");
}

TEST_CASE("one wrong pixel far from any edge is enough to fail") {
  const Compared compared{load("shapes/box.toml")};
  compare::Frame damaged = compared.frame;
  const compare::RasterResult honest = compared.witness.compare(damaged, "honest");
  damaged.first_hits[96 * 60 + 48] = {};
  const compare::RasterResult result = compared.witness.compare(damaged, "damaged");
  CHECK(result.unexplained == 1);
  CHECK(result.equal == honest.equal - 1);
  CHECK(result.pixel == compare::Pixel{48, 60});
}

TEST_CASE("undrawn surfaces are counted, and hide the surfaces behind them rather than show through") {
  const Compared compared{load("shapes/csg.toml")};
  const compare::RasterResult honest = compared.with([](FirstHit&) {});
  CHECK(honest.passes());
  CHECK(honest.not_drawn.at("csg") == 7);
  CHECK(honest.hidden > 1000);
  const Vec3 eye = compared.scene.camera.eye;
  const compare::RasterResult behind = compared.with([&](FirstHit& hit) {
    hit.t *= 50;
    hit.position = eye + (hit.position - eye) * 50.0;
  });
  CHECK(behind.unexplained > 1000);

  const Compared cutouts{load("veil.toml")};
  CHECK(cutouts.with([](FirstHit&) {}).not_drawn.at("with cutouts") == 12);
}
