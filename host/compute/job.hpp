// A kernel with everything that a run of it needs, from a kernel file (docs/kernel-files.md) or from a kernel
// alone.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/compute/interface.hpp"
#include "host/core/diagnostic.hpp"

namespace eyeray::engine::compute {

// A buffer or an image.
struct JobBuffer {
  BufferSlot slot;
  TypePtr type;  // the block, with as many elements as the buffer has; or the image, with its extent
  std::vector<std::byte> bytes;
  std::filesystem::path output{};  // empty: none
  uint64_t width = 0;              // the width of its picture, in pixels
  bool compared = true;            // false: verify does not compare it
};

// A file that a buffer must equal after the run.
struct Expectation {
  size_t buffer = 0;  // index
  std::string file;
  std::vector<std::byte> bytes;
  uint64_t ulp = 0;
  double absolute = 0;  // a distance that is allowed, too
};

struct Job;
// Another kernel that must compute the same.
struct SameAs {
  std::shared_ptr<const Job> job;
  uint64_t ulp = 0;
  std::vector<std::pair<size_t, size_t>> buffers;  // those to compare: index here and there
};

struct Job {
  std::string file;             // as the user named it
  std::string kernel;           // the file of the kernel
  std::vector<uint32_t> spirv;  // one entry point, "main"; specialised; buffer i of `buffers` at binding i
  std::array<uint32_t, 3> local_size{1, 1, 1};
  std::array<uint32_t, 3> groups{1, 1, 1};
  std::vector<JobBuffer> buffers;
  std::vector<std::byte> push;
  uint64_t ulp = 0;  // the distance of reals that verify allows between executors
  std::vector<Expectation> expected;
  std::optional<SameAs> same;
  std::vector<Diagnostic> warnings;
};

// "8×8×1 work groups of 16×1×1 invocations".
std::string describe_dispatch(const Job& job);

// True if a file is a kernel file or a kernel: by its ending, or by the key `kernel` in a .toml. False for a
// file that cannot be read.
bool is_job(const std::filesystem::path& file);

// Reads a kernel file or a kernel. `overrides` are KEY=VALUE, such as push.scale=2, and replace the file's
// values. InputError with all errors at once, if possible; Error (file_io) for files that cannot be read.
Job load_job(const std::string& file, const std::vector<std::string>& overrides);

// Sets the file that a buffer or an image is written to. Error (bad_input) if there is none of that name, or
// if no such file can hold it.
void set_output(Job& job, const std::string& name, const std::filesystem::path& file);

}  // namespace eyeray::engine::compute
