// The trace of one invocation: the lines that it ran, and the values on each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace eyeray::engine::emulator {

// A value that the invocation read, wrote or decided by.
struct TracedValue {
  enum class Kind : uint8_t {
    read,
    write,
    branch,   // the value that decided it
    result,   // the result of a function that returned, or of an instruction of a kernel without lines
    barrier,  // no value
  } kind = Kind::read;
  std::string name{};   // "list[4]"; of an instruction's result "%17"; else empty
  std::string value{};  // "1.5", "(1, 2)", "true", "never set"
  // If another invocation wrote the value in this dispatch: that one's gl_GlobalInvocationID.
  std::optional<std::array<uint32_t, 3>> writer{};
};

struct TracedLine {
  std::string file{};         // empty in a kernel without lines
  uint32_t line = 0;          // from 1; 0 in a kernel without lines
  std::string instruction{};  // "OpIAdd %17", in a kernel without lines
  std::vector<TracedValue> values{};
};

// The last write to a word of a buffer.
struct TracedWrite {
  size_t order = 0;  // its number among the trace's writes
  std::string file{};
  uint32_t line = 0;
};

// Set `invocation` and `follow` before a dispatch; the rest is its result.
struct Trace {
  std::array<uint32_t, 3> invocation{};  // gl_GlobalInvocationID
  std::string follow{};  // keep the lines alone that access this variable, or element; empty: all lines

  std::vector<TracedLine> lines{};  // in the order of execution, a line of a loop each time
  bool cut = false;                 // true if there were more than most_traced_lines
  std::set<std::string> names{};    // the variables that `follow` may name
  // By binding and byte, of the first most_written_words; also those of lines that are not kept.
  std::map<std::pair<uint32_t, uint64_t>, TracedWrite> written{};
  size_t writes = 0;
};

constexpr size_t most_traced_lines = 10000;
constexpr size_t most_written_words = 1 << 16;

}  // namespace eyeray::engine::emulator
