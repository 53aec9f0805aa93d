#include "host/program/bar.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace eyeray::engine::program {
namespace {

// Columns of the terminal on standard error, which may change at any time.
int terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// Columns that a text of single-width characters in UTF-8 takes.
int columns_of(std::string_view text) {
  return int(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string bar(int width, double share) {
  const int full = int(share * width);
  std::string bar;
  for (int i = 0; i < width; ++i) bar += i < full ? "█" : "·";
  return std::getenv("NO_COLOR") ? bar : "\033[36m" + bar + "\033[0m";
}

}  // namespace

std::shared_ptr<Bar> Bar::on_terminal() {
  const char* type = std::getenv("TERM");
  const bool terminal = isatty(STDERR_FILENO) && type && std::strcmp(type, "dumb") != 0;
  return terminal ? std::make_shared<Bar>() : nullptr;
}

Bar::~Bar() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void Bar::draw(std::span<const std::string> texts, double share) {
  const int room = terminal_columns() - 1;
  const auto text =
      std::ranges::find_if(texts, [&](const std::string& each) { return columns_of(each) <= room; });
  if (text == texts.end()) return;
  const int width = std::min(30, room - columns_of(*text) - 1);
  fmt::print(stderr, "\r{}{}\033[K", width < 5 ? "" : bar(width, share) + " ", *text);
  std::fflush(stderr);
  drawn_ = true;
}

std::span<const std::string> compiling_texts() {
  static const std::string texts[] = {"building BVHs and compiling kernels", "compiling kernels",
                                      "compiling"};
  return texts;
}

std::shared_ptr<void> show_compiling(std::string_view and_then) {
  const std::shared_ptr<Bar> bar = Bar::on_terminal();
  if (!bar) return nullptr;
  std::vector<std::string> texts;
  for (const std::string& text : compiling_texts()) texts.push_back(text + std::string(and_then));
  bar->draw(texts, 0);
  return bar;
}

}  // namespace eyeray::engine::program
