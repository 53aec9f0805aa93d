// A running `eyeray dev`.
#pragma once

#include <sstream>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

namespace eyeray::engine::test {

// A running `eyeray dev`, and the position in its output up to which it has been read.
class Dev {
 public:
  Dev(const SceneFolder& folder, const std::string& timeout, const std::vector<std::string>& options = {},
      const Environment& environment = {})
      : process_(command(folder, timeout, options), environment) {}

  // True if it prints `text` from here on.
  bool says(const std::string& text) {
    if (!process_.wait_for_error_text(text, 600, seen_)) {
      MESSAGE("no '", text, "' in: ", process_.err().substr(seen_));
      return false;
    }
    seen_ = process_.err().find(text, seen_) + text.size();
    return true;
  }
  // The process id of its worker, which is its only child; 0 if there is none.
  pid_t worker() const {
    const std::string pid = std::to_string(process_.pid());
    std::istringstream children(read_text("/proc/" + pid + "/task/" + pid + "/children"));
    pid_t child = 0;
    children >> child;
    return child;
  }
  Process& process() { return process_; }

 private:
  static std::vector<std::string> command(const SceneFolder& folder, const std::string& timeout,
                                          const std::vector<std::string>& options) {
    std::vector<std::string> words{
        eyeray_binary(),  "dev",       folder.scene(), "--shaders", folder / "shaders", "-o",
        folder / "a.pfm", "--timeout", timeout};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }

  Process process_;
  size_t seen_ = 0;
};

}  // namespace eyeray::engine::test
