// Counts the iterations of loops in a user's shaders, so that a loop without an end is stopped and named.
// Without a count, optimisers remove such a loop, and drivers that cap loops go on behind it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/error.hpp"

namespace eyeray::engine::executors {

class LoopGuard {
 public:
  // `most`: the iterations that all counted loops of one invocation may make together. The default is for
  // executors that do not cap loops.
  explicit LoopGuard(uint32_t most = 1 << 20) : most_(most) {}

  // The definitions that guarded text needs, as GLSL: for the scene's text, which every kernel includes
  // first. The twin has its own (twin/shader_functions.hpp).
  std::string definitions() const;
  // `text` of a file that takes the place of eyeray's `original`, called `shown` in messages. Counts the
  // loops of all functions that `original` does not have; no line moves.
  std::string guard(const std::string& shown, std::string_view text, std::string_view original);
  // True if any text that was guarded differs from eyeray's.
  bool active() const { return !files_.empty(); }

  uint32_t most() const { return most_; }
  // Error (timed_out), which names the loops of these bits: the twin calls it where a count is used up.
  [[noreturn]] void stop(uint32_t stopped) const;
  // Error (timed_out), which names the loops that may be meant, where the flags of a result state that a loop
  // did not end. `ray_kinds`: whether the kernel counted them (records.h, SampleResult).
  void check(uint32_t flags, bool ray_kinds) const;
  // A time-out with the counted loops added to it.
  Error explained(const Error& time_out) const;

 private:
  // The outermost loop of a nest.
  struct Loop {
    std::string file;
    int line;
    std::string text;  // of that line

    bool operator==(const Loop&) const = default;
  };
  uint32_t bit_of(const Loop& loop);
  std::string list(uint32_t bits) const;

  uint32_t most_;
  std::vector<std::string> files_;  // that differ from eyeray's own
  std::vector<Loop> loops_;
};

}  // namespace eyeray::engine::executors
