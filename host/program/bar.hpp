// The line on a terminal with a command's progress.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace eyeray::engine::program {

// A line that is drawn over itself, and wiped away at the end. It never fills the terminal's last column,
// after which a terminal begins another line.
class Bar {
 public:
  // Null where standard error is no terminal that can draw over a line.
  static std::shared_ptr<Bar> on_terminal();
  ~Bar();
  // Draws the first of `texts` that fits, behind a bar if there is room for one.
  void draw(std::span<const std::string> texts, double share);

 private:
  bool drawn_ = false;
};

// The texts of the progress line while kernels compile, from the longest to the shortest.
std::span<const std::string> compiling_texts();

// Shows on a terminal that kernels compile, on the progress line, for commands that report no progress.
// `and_then` is added to the line. Before anything else is printed, the returned pointer must be released,
// which wipes the line away.
std::shared_ptr<void> show_compiling(std::string_view and_then = "");

}  // namespace eyeray::engine::program
