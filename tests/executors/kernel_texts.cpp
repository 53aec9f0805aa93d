// Compares the text that specialisation writes for scenes with the stored one, so that a review of a change
// shows its effect on kernels.
#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
#include "tests/support/entries.hpp"
#include "tests/support/snapshot.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

TEST_CASE("the text that specialisation writes for a scene is the one that was reviewed") {
  for (const std::string name :
       {"whitted", "textures", "meshes", "forest", "blend", "shapes/csg", "cameras/formula",
        "cameras/thin_lens", "path/cornell_box", "path/materials", "path/fog", "sppm/box"}) {
    CAPTURE(name);
    const records::PackedScene scene = pack::pack(loader::load_scene("scenes/" + name + ".toml"));
    // Numbers of constants are the scene's own, but one scene shows how they are written.
    const std::string text = executors::specialise(scene, {.constants = name == "whitted"});
    std::string file = name;
    std::ranges::replace(file, '/', '_');
    test::check_snapshot("tests/executors/kernels/" + file + ".glsl", text);
  }
}
