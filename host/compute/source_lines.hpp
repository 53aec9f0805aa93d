// The text of the lines that a kernel's debug information names.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace eyeray::engine::compute {

class SourceLines {
 public:
  explicit SourceLines(std::span<const uint32_t> spirv);
  // A line, from 1, without white space at its end. It is that of the file; without such a file that of the
  // text in the SPIR-V; else empty.
  std::string line(const std::string& file, uint32_t number);

 private:
  std::map<std::string, std::string> embedded_;           // by file
  std::map<std::string, std::vector<std::string>> read_;  // by file
};

}  // namespace eyeray::engine::compute
