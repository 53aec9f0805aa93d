// Kernels and kernel files in a folder of their own.
#pragma once

#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "host/compute/run.hpp"
#include "host/compute/verify.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

namespace eyeray::engine::test {

class KernelFolder : public TemporaryFolder {
 public:
  // A kernel whose main() has this body, in line 4 of k.comp, and a kernel file k.toml.
  KernelFolder(const std::string& declarations, const std::string& body, const std::string& toml) {
    write_text(path() / "k.comp", "#version 450\n" + declarations + "\nvoid main() {\n" + body + "\n}\n");
    write_text(path() / "k.toml", "kernel = \"k.comp\"\n" + toml);
  }

  compute::Job job(const std::vector<std::string>& overrides = {}) const {
    return compute::load_job(*this / "k.toml", overrides);
  }
  compute::Outcome emulated(const std::vector<std::string>& overrides = {}) const {
    compute::RunOptions how;
    how.device.emulate = true;
    return compute::run(job(overrides), how);
  }
  compare::Report verified(const std::vector<std::string>& overrides = {}) const {
    return compute::verify_job(job(overrides), {.run = {}});
  }
  // The error that loading the job ends with; "" if there is none.
  std::string refusal(const std::vector<std::string>& overrides = {}) const {
    try {
      job(overrides);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

inline const std::string lines64 = "layout(local_size_x = 64) in; ";
inline const std::string two_buffers = lines64 +
                                       "layout(std430, binding = 0) buffer Source { float source[]; }; "
                                       "layout(std430, binding = 1) buffer Target { float target[]; }; ";

template <typename T>
std::vector<T> records(const std::vector<std::byte>& bytes) {
  std::vector<T> all(bytes.size() / sizeof(T));
  std::memcpy(all.data(), bytes.data(), all.size() * sizeof(T));
  return all;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace eyeray::engine::test
