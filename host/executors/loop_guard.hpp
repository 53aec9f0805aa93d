// Counts the iterations of loops in a user's shaders, so that a loop without an end is stopped and named.
// Without a count, optimisers remove such a loop, and drivers that cap loops continue after it.
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

  // The GLSL definitions that guarded text needs. They belong in the scene's text, which every kernel
  // includes first. The twin has its own definitions (twin/shader_functions.hpp).
  std::string definitions() const;
  // `text` with its loops counted, in all functions that `original` does not have; no line moves. `text` is a
  // file that takes the place of eyeray's `original`. Messages name the file `shown`.
  std::string guard(const std::string& shown, std::string_view text, std::string_view original);
  // True if any text that was guarded differs from eyeray's.
  bool active() const { return !files_.empty(); }

  uint32_t most() const { return most_; }
  // Throws Error (timed_out), which names the loops of the bits `stopped`. The twin calls it when the count
  // is used up.
  [[noreturn]] void stop(uint32_t stopped) const;
  // Throws Error (timed_out), which names the possible loops, if the flags of a result state that a loop did
  // not end. `ray_kinds`: whether the kernel counted reflected and refracted rays (records.h, SampleResult).
  void check(uint32_t flags, bool ray_kinds) const;
  // The error of a time-out, with a list of the counted loops added.
  Error explained(const Error& time_out) const;

 private:
  // The outermost loop of a nest.
  struct Loop {
    std::string file;
    int line;
    std::string text;  // the text of that line

    bool operator==(const Loop&) const = default;
  };
  uint32_t bit_of(const Loop& loop);
  std::string list(uint32_t bits) const;

  uint32_t most_;
  std::vector<std::string> files_;  // the files that differ from eyeray's own
  std::vector<Loop> loops_;
};

}  // namespace eyeray::engine::executors
