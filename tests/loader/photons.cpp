// Scenes of the suite that photons cannot light. All other scenes are verified with photons
// (tests/scene/entries.cmake).
#include <fstream>

#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

TEST_CASE("`sppm` refuses these scenes of the suite; its errors state the position and the reason") {
  std::ifstream list("tests/loader/refused_by_sppm.txt");
  int scenes = 0;
  for (std::string line; std::getline(list, line); ++scenes) {
    CAPTURE(line);
    const size_t middle = line.find(" | ");
    REQUIRE(middle != std::string::npos);
    std::string message;
    try {
      load_scene(line.substr(0, middle), std::vector<Override>{{"render.integrator=\"sppm\""}});
    } catch (const InputError& error) {
      message = error.what();
    }
    CHECK(message.substr(0, message.find('\n')) == line.substr(middle + 3));
  }
  CHECK(scenes > 0);
}
