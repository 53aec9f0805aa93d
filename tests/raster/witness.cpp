// Gate R on whole scenes: honest first hits pass, and damaged ones do not.
#include "host/raster/witness.hpp"

#include <functional>

#include "host/executors/executor.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::raster;

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

  // What gate R says once each hit is damaged.
  compare::RasterResult with(const std::function<void(FirstHit&)>& damage) const {
    compare::Frame damaged = frame;
    for (FirstHit& hit : damaged.first_hits) damage(hit);
    return witness.compare(damaged, "damaged");
  }
};

}  // namespace

TEST_CASE("the reference's rays of a mesh, of a crop, of parallel rays, hit what is drawn") {
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

TEST_CASE("neighbours' ids, another t, another place, a miss and a ghost are each found") {
  const Compared compared{load("meshes.toml")};
  const auto fails = [&](const std::function<void(FirstHit&)>& damage, const char* reason) {
    CAPTURE(reason);
    const compare::RasterResult result = compared.with(damage);
    CHECK_FALSE(result.passes());
    CHECK(result.difference.find(reason) != std::string::npos);
    return result.unexplained;
  };
  CHECK(fails([](FirstHit& hit) { hit.primitive ^= hit.primitive >= 0 ? 1 : 0; }, "the ray hits what") >
        5000);
  fails([](FirstHit& hit) { hit.t *= 1.0001; }, "its position falls");
  fails([](FirstHit& hit) { hit.position.x += 1e-3; }, "its position falls");
  fails([](FirstHit& hit) { hit.position = Vec3(std::nan("")); }, "no number");
  fails(
      [](FirstHit& hit) {
        if (hit.primitive == 0) hit = {};
      },
      "the ray hits what cannot be there");
  fails(
      [](FirstHit& hit) {
        if (hit.primitive > 0) hit.primitive = 1 << 30;
      },
      "the ray hits what");
  // Both t and place, along the ray.
  const Vec3 eye = compared.scene.camera.eye;
  fails(
      [&](FirstHit& hit) {
        hit.t *= 1.0001;
        hit.position = eye + (hit.position - eye) * 1.0001;
      },
      "the ray hits what cannot be there");
}

TEST_CASE("one pixel is enough, far from any edge") {
  const Compared compared{load("shapes/box.toml")};
  compare::Frame damaged = compared.frame;
  const compare::RasterResult honest = compared.witness.compare(damaged, "honest");
  damaged.first_hits[96 * 60 + 48] = {};
  const compare::RasterResult result = compared.witness.compare(damaged, "damaged");
  CHECK(result.unexplained == 1);
  CHECK(result.equal == honest.equal - 1);
  CHECK(result.pixel == compare::Pixel{48, 60});
}

TEST_CASE("what is not drawn is counted, and hides what is behind it; it does not show through") {
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
