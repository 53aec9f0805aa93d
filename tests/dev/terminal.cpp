// Pictures as terminals take them.
#include "host/dev/terminal.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "host/core/error.hpp"
#include "host/image/srgb.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::dev;

namespace {

// Its left half is red, its right half blue.
image::Image red_and_blue(int width, int height) {
  image::Image picture(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture.pixel(x, y)[x < width / 2 ? 0 : 2] = 1;
  return picture;
}

}  // namespace

TEST_CASE("half blocks hold two pixels a character") {
  CHECK(in_terminal(red_and_blue(2, 2), TerminalGraphics::blocks, {}) ==
        "\x1b[38;2;255;0;0m\x1b[48;2;255;0;0m▀\x1b[38;2;0;0;255m\x1b[48;2;0;0;255m▀\x1b[0m\n");
  // An odd last row leaves the lower half to the terminal.
  CHECK(in_terminal(red_and_blue(1, 1), TerminalGraphics::blocks, {}) ==
        "\x1b[38;2;0;0;255m\x1b[49m▀\x1b[0m\n");
  // A large one is made to fit, the line of the prompt left free.
  const std::string small = in_terminal(red_and_blue(640, 480), TerminalGraphics::blocks, {40, 11});
  CHECK(std::ranges::count(small, '\n') == 10);
  CHECK(small.find("\x1b[38;2;255;0;0m") == 0);
}

TEST_CASE("what lies between the colors of sixels is dithered") {
  // #43 is 20 % of all three components, #86 is 40 %; 30 % lies between them.
  image::Image grey(8, 6, 3);
  for (float& sample : grey.samples()) sample = float(image::linear_from_srgb(0.3));
  const std::string text = in_terminal(grey, TerminalGraphics::sixel, {});
  const std::string body = text.substr(text.rfind("#215;2;100;100;100") + 18);
  int lit[2] = {0, 0};
  for (const int dark : {0, 1}) {
    const size_t from = body.find(dark ? "#43" : "#86");
    REQUIRE(from != std::string::npos);
    for (size_t i = from + 3; body[i] != '$'; ++i) lit[dark] += std::popcount(unsigned(body[i] - '?'));
  }
  CHECK(lit[0] + lit[1] == 48);
  CHECK(std::abs(lit[0] - lit[1]) <= 8);
}

TEST_CASE("sixels run along bands of six rows") {
  const std::string text = in_terminal(red_and_blue(8, 7), TerminalGraphics::sixel, {});
  CHECK(text.starts_with("\x1bPq\"1;1;8;7#0;2;0;0;0"));
  CHECK(text.find("#180;2;100;0;0") != std::string::npos);
  // Blue then red, six rows and then one.
  CHECK(text.ends_with("#5!4?!4~$#180!4~!4?$-#5!4?!4@$#180!4@!4?$-\x1b\\\n"));
}

TEST_CASE("kitty takes a PNG in pieces") {
  image::Image noisy(200, 100, 3);
  uint32_t random = 1;
  for (float& sample : noisy.samples())
    sample = float((random = random * 1664525 + 1013904223) >> 8) / (1 << 24);
  const std::string text = in_terminal(noisy, TerminalGraphics::kitty, {});
  CHECK(text.starts_with("\x1b_Ga=T,f=100,m=1;iVBORw0KGgo"));
  CHECK(text.find("\x1b\\\x1b_Gm=1;") != std::string::npos);
  CHECK(text.find("\x1b_Gm=0;") != std::string::npos);
  CHECK(text.ends_with("\x1b\\\n"));
}

TEST_CASE("which of them is what the environment says") {
  for (const char* name : {"KITTY_WINDOW_ID", "TERM_PROGRAM"}) unsetenv(name);
  setenv("TERM", "xterm-256color", 1);
  CHECK(parse_terminal_graphics("auto") == TerminalGraphics::blocks);
  setenv("TERM", "foot", 1);
  CHECK(parse_terminal_graphics("auto") == TerminalGraphics::sixel);
  setenv("KITTY_WINDOW_ID", "1", 1);
  CHECK(parse_terminal_graphics("auto") == TerminalGraphics::kitty);
  CHECK(parse_terminal_graphics("blocks") == TerminalGraphics::blocks);
  CHECK_THROWS_AS(parse_terminal_graphics("ascii"), Error);
}
