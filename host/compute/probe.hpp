// Traces one invocation of a job, and compares the numbers that it wrote with the device's.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/compute/run.hpp"
#include "host/emulator/trace.hpp"

namespace eyeray::engine::compute {

struct ProbeOptions {
  RunOptions run;
  bool on_device = true;                 // also run the kernel on the device
  std::array<uint32_t, 3> invocation{};  // gl_GlobalInvocationID
  std::string follow{};  // show the lines alone that access this variable or element; empty: all
};

// A number of a buffer that the invocation wrote, after the run.
struct ProbedNumber {
  std::string name;      // "Sums.sums[5]"
  std::string emulator;  // its value
  std::string gpu{};     // empty if the device did not run the kernel
  uint64_t apart = 0;    // in units in the last place; of integers their difference
  bool differs = false;  // by more than the job allows
  emulator::TracedWrite by{};
};

struct Probed {
  emulator::Trace trace;
  std::vector<std::string> source;                 // the text of each line of the trace
  std::vector<std::string> executors;              // their descriptions
  std::vector<ProbedNumber> numbers;               // in the order of the last writes
  std::vector<std::string> notes;                  // a sentence each
  std::optional<size_t> first_difference() const;  // index of a number
};

// Error (bad_input) if the dispatch has no such invocation, or the kernel no such variable; the errors of
// run().
Probed probe(const Job& job, const ProbeOptions& options);

// For people, with a newline after every line.
std::string to_text(const Job& job, const Probed& probed);

}  // namespace eyeray::engine::compute
