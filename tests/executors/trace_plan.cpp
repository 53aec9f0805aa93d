// Tests which pictures packets trace, and which pictures use vectors of 512 bits.
#include "host/executors/trace_plan.hpp"

#include "host/materials/make.hpp"
#include "host/pack/pack.hpp"
#include "host/scene/integrator.hpp"
#include "host/shapes/make.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

records::PackedScene spheres(int count) {
  Scene scene = test::empty_scene();
  const int material = test::add(scene, materials::make_phong({}));
  for (int i = 0; i < count; ++i) test::add(scene, shapes::make_sphere(Vec3(i, 0, -9), 0.5), material);
  return pack::pack(scene);
}

ImageSettings picture(int width, int height, int samples = 1) {
  ImageSettings image;
  image.width = width;
  image.height = height;
  image.samples = samples;
  return image;
}

ProfileOptions rays(const std::string& how) {
  ProfileOptions options;
  options.rays = how;
  return options;
}

}  // namespace

TEST_CASE("pictures of a million samples want wide vectors, except big scenes in packets") {
  const records::PackedScene few = spheres(3), many = spheres(2000), most = spheres(17'000);
  for (const records::PackedScene* scene : {&few, &many, &most}) {
    CHECK_FALSE(wants_wide_vectors({}, picture(768, 768), *scene));
    CHECK(wants_wide_vectors({}, picture(1024, 1024), *scene));
    CHECK(wants_wide_vectors({}, picture(512, 512, 4), *scene));
    CHECK(wants_wide_vectors(rays("lanes"), picture(2048, 2048), *scene));
    CHECK(wants_wide_vectors({}, picture(2048, 2048), *scene) == (scene != &most));
  }
  CHECK_FALSE(wants_wide_vectors(rays("packets"), picture(2048, 2048), many));
  records::PackedScene gathering = few;
  gathering.frame.integrator = uint32_t(IntegratorType::sppm);
  CHECK_FALSE(wants_wide_vectors({}, picture(2048, 2048), gathering));
}

TEST_CASE("packets trace big pictures if vectors are narrow, or on request") {
  const records::PackedScene scene = spheres(2000);
  gpu::DeviceInfo cpu;
  cpu.type = gpu::DeviceType::cpu;
  const auto wavefront = [&](const ProfileOptions& requested, uint32_t lanes) {
    return plan_tracing(choose_profile(requested, cpu), requested, picture(2048, 2048), scene, lanes)
        .wavefront;
  };
  CHECK(wavefront({}, 8));
  CHECK_FALSE(wavefront({}, 16));
  CHECK(wavefront(rays("packets"), 16));
  CHECK_FALSE(wavefront(rays("lanes"), 8));

  // Random paths go alone, in wide vectors however big the scene is.
  for (const int count : {2000, 17'000}) {
    records::PackedScene paths = spheres(count);
    paths.frame.integrator = uint32_t(IntegratorType::path);
    CHECK_FALSE(plan_tracing(choose_profile({}, cpu), {}, picture(2048, 2048), paths, 8).wavefront);
    CHECK(plan_tracing(choose_profile(rays("packets"), cpu), rays("packets"), picture(2048, 2048), paths, 8)
              .wavefront);
    CHECK(wants_wide_vectors({}, picture(2048, 2048), paths));
  }
}
