// Progress on a terminal.
#include <algorithm>
#include <csignal>
#include <regex>

#include "scene.hpp"
#include "terminal.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The successive drawings of a line that is drawn over itself, without colours.
std::vector<std::string> drawings(const std::string& shown) {
  const std::string text = std::regex_replace(shown, std::regex("\033\\[[0-9]*m"), "");
  std::vector<std::string> result;
  for (size_t begin = 0, end; (end = text.find("\033[K", begin)) != std::string::npos; begin = end + 3) {
    CHECK(text[begin] == '\r');
    result.push_back(text.substr(begin + 1, end - begin - 1));
  }
  return result;
}

int columns(const std::string& text) {
  return int(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

}  // namespace

TEST_CASE("progress keeps to one line of a terminal of any width, also when the width changes") {
  const SceneFolder folder;
  const std::string render =
      "render " + folder.scene() + " --backend twin --spp 65536 -o " + folder / "a.png";
  for (const int width : {200, 78, 60, 40, 24, 12}) {
    CAPTURE(width);
    Terminal terminal(width);
    Process eyeray(terminal.command(render), xterm);
    // Waits for the first drawing of the bar, and for another.
    REQUIRE(terminal.wait_for(" %"));
    REQUIRE(terminal.wait_for("\r", terminal.shown().size()));
    eyeray.send_signal(SIGINT);
    eyeray.wait(600);
    const std::string shown = terminal.shown();
    for (const std::string& drawing : drawings(shown.substr(0, shown.rfind("\r\033[K")))) {
      CAPTURE(drawing);
      CHECK(columns(drawing) < width);
      if (width >= 78) CHECK(drawing.find("·") != std::string::npos);
    }
  }

  Terminal terminal(120);
  Process eyeray(terminal.command(render), xterm);
  REQUIRE(terminal.wait_for(" left"));
  CHECK(std::ranges::any_of(drawings(terminal.shown()), [](const auto& each) { return columns(each) > 60; }));
  terminal.set_columns(40);
  // A drawing of the old width may have been under way, so the next one is skipped.
  const size_t changed = terminal.shown().size();
  REQUIRE(terminal.wait_for("\033[K", changed));
  const size_t after = terminal.shown().size();
  REQUIRE(terminal.wait_for("\033[K\r", after));
  const std::string narrow = terminal.shown();
  const size_t begin = narrow.find('\r', after);
  for (const std::string& drawing : drawings(narrow.substr(begin))) CHECK(columns(drawing) < 40);
  eyeray.send_signal(SIGINT);
  eyeray.wait(600);
}

TEST_CASE("a terminal shows that kernels compile, and compiling is no part of the first estimate") {
  const SceneFolder folder;
  Terminal terminal(100);
  Process eyeray(terminal.command("render " + folder.scene() + " --spp 65536 -o " + folder / "a.png"), xterm);
  REQUIRE(terminal.wait_for(" left"));
  const std::vector<std::string> shown = drawings(terminal.shown());
  REQUIRE(shown.size() >= 2);
  CHECK(shown[0] == "······························ building BVHs and compiling kernels");
  eyeray.send_signal(SIGINT);
  eyeray.wait(600);

  // `verify` shows this before each executor.
  Terminal other(100);
  Process verify(other.command("verify " + folder.scene() + " >/dev/null"), xterm);
  size_t from = 0;
  for (int executor = 0; executor < 3; ++executor) {
    REQUIRE(other.wait_for("compiling kernels", from));
    from = other.shown().find("compiling kernels", from) + 1;
  }
  verify.wait(600);
}

TEST_CASE("probe and dev show that kernels compile, and wipe the line away") {
  const SceneFolder folder;
  for (const std::string& command :
       {"probe " + folder.scene() + " 3,3 >/dev/null", "dev " + folder.scene() + " --once"}) {
    CAPTURE(command);
    Terminal terminal(100);
    Process eyeray(terminal.command(command), xterm);
    CHECK(terminal.wait_for("building BVHs and compiling kernels"));
    eyeray.wait(600);
    CHECK(eyeray.code() == 0);
    const std::string& shown = terminal.shown();
    CHECK(shown.rfind("compiling kernels") < shown.rfind("\r\033[K"));
  }
}

TEST_CASE("a terminal shows how far denoising is") {
  const SceneFolder folder;
  Terminal terminal(100);
  Process eyeray(
      terminal.command("render scenes/path/cornell_box.toml -s 400x300 --spp 2 --denoise --backend "
                       "twin -o " +
                       folder / "a.png"),
      xterm);
  REQUIRE(terminal.wait_for("denoising"));
  eyeray.wait(600);
  CHECK(eyeray.code() == 0);
  std::vector<int> shares;
  const std::string shown = terminal.shown();
  for (const std::string& drawing : drawings(shown.substr(0, shown.rfind("\r\033[K"))))
    if (const size_t at = drawing.find(" %  denoising"); at != std::string::npos)
      shares.push_back(std::stoi(drawing.substr(at - 3, 3)));
  CHECK(shares.size() > 1);
  CHECK(std::ranges::is_sorted(shares));
  CHECK(shares.back() > 50);
}
