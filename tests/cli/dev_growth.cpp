// eyeray dev after many edits.
#include <filesystem>

#include "dev.hpp"
#include "tests/support/amount.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

struct Holding {
  long kilobytes = 0;
  long files = 0;
};

// The memory and the file descriptors of a process.
Holding held_by(pid_t pid) {
  const std::string folder = "/proc/" + std::to_string(pid);
  std::istringstream status(read_text(folder + "/status"));
  Holding holding;
  for (std::string word; status >> word;)
    if (word == "VmRSS:") status >> holding.kilobytes;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(folder + "/fd"))
    ++holding.files;
  return holding;
}

}  // namespace

TEST_CASE("a thousand edits leave no memory and no file behind" * doctest::test_suite("long")) {
  const SceneFolder folder;
  const std::string shader = folder / "shaders/shapes/sphere.glsl";
  REQUIRE(run_eyeray({"shaders", "--export", folder / "shaders"}).code == 0);
  const std::string good_shader = read_text(shader), good_scene = read_text(folder.scene());
  Dev dev(folder, "600");
  REQUIRE(dev.says("watching for changes"));
  const pid_t worker = dev.worker();
  const auto edit = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      if (i % 4 == 0)
        write_text(shader, replaced(good_shader, "SHADER_END",
                                    fmt::format("float edit() {{ return {}.0f; }}\nSHADER_END", i)));
      else
        write_text(folder.scene(),
                   replaced(good_scene, "radius = 1", fmt::format("radius = {}", 1 + i * 1e-4)));
      REQUIRE(dev.says("rendered "));
    }
  };
  const int edits = amount(60, 100, 1000);
  edit(1, edits / 4);
  const Holding supervisor_before = held_by(dev.process().pid()), worker_before = held_by(worker);
  edit(edits / 4, edits);
  REQUIRE(dev.worker() == worker);
  const Holding supervisor_after = held_by(dev.process().pid()), worker_after = held_by(worker);
  CHECK(supervisor_after.files == supervisor_before.files);
  CHECK(worker_after.files == worker_before.files);
  // A picture has 36 KiB, a kernel more.
  CHECK(supervisor_after.kilobytes < supervisor_before.kilobytes + 8 * edits);
  CHECK(worker_after.kilobytes < worker_before.kilobytes + 8 * edits);
}
