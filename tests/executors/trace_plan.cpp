// Which pictures want vectors of 512 bits.
#include "host/executors/trace_plan.hpp"

#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::executors;

namespace {

bool wants_wide_vectors(const std::string& file, int width, int height, int samples = 1,
                        const ProfileOptions& asked = {}) {
  Scene scene = loader::load_scene(file);
  scene.image.width = width;
  scene.image.height = height;
  scene.image.samples = samples;
  return wants_wide_vectors(asked, scene.image, pack::pack(scene));
}

}  // namespace

TEST_CASE("big pictures want wide vectors, but for those that packets trace") {
  for (const std::string file :
       {"scenes/whitted.toml", "scenes/shapes/csg.toml", "scenes/shapes/torus.toml"}) {
    CAPTURE(file);
    CHECK_FALSE(wants_wide_vectors(file, 768, 768));
    CHECK(wants_wide_vectors(file, 1024, 1024));
    CHECK(wants_wide_vectors(file, 640, 480, 4));
  }
  ProfileOptions lanes, packets;
  lanes.rays = "lanes";
  packets.rays = "packets";
  const std::string mesh = "scenes/cornell.toml";
  CHECK(wants_wide_vectors(mesh, 1024, 1024));
  CHECK_FALSE(wants_wide_vectors(mesh, 1024, 1024, 1, packets));
  CHECK_FALSE(wants_wide_vectors(mesh, 2048, 2048));
  CHECK(wants_wide_vectors(mesh, 2048, 2048, 1, lanes));
}
