// The contents of buffers and push constants, from a kernel file. Private to this layer.
#pragma once

#include <optional>

#include "host/compute/document.hpp"
#include "host/compute/job.hpp"

namespace eyeray::engine::compute {

// Writes a value of TOML. A vector, a matrix (its columns) or an array is a list, which may also be one list
// of all numbers. A structure is a table, in which members may be missing. False, with errors in the log, if
// the value is of another form.
bool assign(const toml::node& node, const Type& type, std::span<std::byte> bytes, DiagnosticLog& log);

// The elements of a block's run-time array that a value of TOML has; nothing if it has no list for it.
std::optional<uint64_t> elements_in(const toml::node& node, const Type& block);

// Writes seeded numbers: number i is mix(seed + (i + 1) · 0x9e3779b97f4a7c15) of SplitMix64. `to`: by default
// 1 for reals, 7 for integers.
struct Noise {
  uint64_t seed = 0;
  double from = 0;
  std::optional<double> to{};
};
// False if a number's kind does not hold the range.
bool fill_with_noise(const Noise& noise, const Type& type, std::span<std::byte> bytes);

// Reads [buffer.NAME] or [image.NAME], or makes the default contents of one that is not in the file.
// `invocations`: of the dispatch along its axes, which decide the length of a run-time array or the size of
// an image if nothing else does. Errors go to the log.
JobBuffer read_buffer(const BufferSlot& slot, uint64_t seed, const toml::table* table,
                      const Document& document, const std::array<uint64_t, 3>& invocations,
                      DiagnosticLog& log);

// The sized block of so many bytes at most as a buffer may have. Error (bad_input) if there are more.
TypePtr sized(const BufferSlot& slot, uint64_t elements);

}  // namespace eyeray::engine::compute
