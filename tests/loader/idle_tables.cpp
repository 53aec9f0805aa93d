// Keys that change nothing in a scene cause a warning that states why.
#include <fmt/ranges.h>

#include "host/loader/scene_file.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

// The warnings about idle keys of a scene with these lines, each as "line: message".
std::vector<std::string> warnings_of(const std::string& text) {
  std::vector<std::string> found;
  for (const Diagnostic& warning : loader::parse_scene(text, "scene.toml").warnings)
    if (warning.message.find("invisible") != std::string::npos ||
        warning.message.find("has no effect") != std::string::npos)
      found.push_back(fmt::format("{}: {}", warning.position.line, warning.message));
  return found;
}

std::string medium(const std::string& lines) {
  return "[render]\nintegrator = \"path\"\nbackground = [1, 1, 1]\n[medium]\n" + lines;
}

}  // namespace

TEST_CASE("a medium with an extent, but without absorption and scattering, is invisible") {
  const std::vector<std::string> expected{
      "5: [medium] is invisible: it has neither `absorption` nor `scattering`; give it one of them, or "
      "remove the "
      "table"};
  for (const char* lines : {"min = [0, 0, 0]\nmax = [1, 1, 1]\n", "top = 3\n", "scale_height = 2\nbase = 1\n",
                            "anisotropy = 0.5\n", "top = 3\nabsorption = 0\nscattering = [0, 0, 0]\n"}) {
    CAPTURE(lines);
    CHECK(warnings_of(medium(lines)) == expected);
  }
  for (const char* lines : {"top = 3\nabsorption = 0.1\n", "top = 3\nscattering = [0, 0, 0.1]\n",
                            "scale_height = 2\nabsorption = [0.1, 0, 0]\n", ""}) {
    CAPTURE(lines);
    CHECK(warnings_of(medium(lines)).empty());
  }
}

TEST_CASE("a camera without an aperture gives a warning for `focus` and blades, which have no effect") {
  const std::string camera = "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n";
  CHECK(warnings_of(camera + "focus = 4\n") ==
        std::vector<std::string>{"4: `focus` has no effect without an `aperture`: everything is sharp"});
  CHECK(warnings_of(camera + "aperture = 0\nblades = 5\n") ==
        std::vector<std::string>{"5: `blades` has no effect without an `aperture`: everything is sharp"});
  CHECK(warnings_of(camera + "aperture = 0.1\nfocus = 4\nblades = 5\n").empty());
}
