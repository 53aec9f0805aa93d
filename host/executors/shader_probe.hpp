// PROBE in shaders: the making of a kernel that records probed values, and the meaning of its records.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/core/ray_tree.hpp"
#include "host/records/packer.hpp"

namespace eyeray::engine::executors {

// Every PROBE in shader files.
class ShaderProbe {
 public:
  // `files`: name → text.
  explicit ShaderProbe(const std::map<std::string, std::string, std::less<>>& files);

  // The defines that make kernels/render.comp.glsl record.
  std::string defines() const;
  // The number of records in BINDING_PROBE's buffer.
  static constexpr size_t capacity = size_t{RayRecorder::most} + 1;
  // The tree of rays that the records describe.
  RayTree tree(std::span<const shader::ProbeRecord> records) const;

  // Sets the file of each value, found by the value's name and line.
  void name_files(RayTree& tree) const;

 private:
  struct Position {
    std::string file;
    uint32_t line;
  };
  std::map<std::string, std::vector<Position>, std::less<>> positions_;  // by name
};

}  // namespace eyeray::engine::executors
