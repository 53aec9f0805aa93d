// Progress on a terminal: a pseudoterminal whose width the test sets.
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <csignal>
#include <regex>

#include "scene.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::test;

namespace {

class Terminal {
 public:
  explicit Terminal(int columns) {
    REQUIRE(master_ >= 0);
    REQUIRE(grantpt(master_) == 0);
    REQUIRE(unlockpt(master_) == 0);
    name_ = ptsname(master_);
    slave_ = open(name_.c_str(), O_RDWR | O_NOCTTY);
    REQUIRE(slave_ >= 0);
    set_columns(columns);
  }
  ~Terminal() {
    close(slave_);
    close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // What runs eyeray with standard error here.
  std::vector<std::string> command(const std::string& arguments) const {
    return {"sh", "-c", "exec " + eyeray_binary() + " " + arguments + " 2>" + name_};
  }
  void set_columns(int columns) {
    const winsize size{24, static_cast<unsigned short>(columns), 0, 0};
    REQUIRE(ioctl(master_, TIOCSWINSZ, &size) == 0);
  }
  // Reads until `text` was written after position `from`, or nothing more is for ten minutes.
  bool wait_for(const std::string& text, size_t from = 0) {
    while (shown_.find(text, from) == std::string::npos)
      if (!read_some(600'000)) return false;
    return true;
  }
  // All that was written until now.
  const std::string& shown() {
    while (read_some(0)) continue;
    return shown_;
  }

 private:
  bool read_some(int milliseconds) {
    pollfd wanted{master_, POLLIN, 0};
    if (poll(&wanted, 1, milliseconds) != 1) return false;
    char bytes[4096];
    const ssize_t count = read(master_, bytes, sizeof bytes);
    if (count > 0) shown_.append(bytes, size_t(count));
    return count > 0;
  }

  int master_ = posix_openpt(O_RDWR | O_NOCTTY);
  int slave_ = -1;
  std::string name_;
  std::string shown_;
};

// What is drawn over itself, drawing by drawing, without colours.
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

const Environment xterm{{"TERM", "xterm"}, {"NO_COLOR", "1"}};

}  // namespace

TEST_CASE("progress keeps to one line of a terminal of any width, also when the width changes") {
  const SceneFolder folder;
  const std::string render =
      "render " + folder.scene() + " --backend twin --spp 65536 -o " + folder / "a.png";
  for (const int width : {200, 78, 60, 40, 24, 12}) {
    CAPTURE(width);
    Terminal terminal(width);
    Process eyeray(terminal.command(render), xterm);
    // The first bar, and another.
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
  // A drawing may have been under way.
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

  // verify, before each executor.
  Terminal other(100);
  Process verify(other.command("verify " + folder.scene() + " >/dev/null"), xterm);
  size_t from = 0;
  for (int executor = 0; executor < 3; ++executor) {
    REQUIRE(other.wait_for("compiling kernels", from));
    from = other.shown().find("compiling kernels", from) + 1;
  }
  verify.wait(600);
}

TEST_CASE("probe, bench and dev show that kernels compile, and wipe the line away") {
  const SceneFolder folder;
  for (const std::string& command :
       {"probe " + folder.scene() + " 3,3 >/dev/null",
        "bench " + folder.scene() + " -n 1 --no-pictures >/dev/null", "dev " + folder.scene() + " --once"}) {
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
