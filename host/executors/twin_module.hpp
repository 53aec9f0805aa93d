// The twin of a user's shaders. They are compiled as C++, with full debug information, into a shared object
// that this process loads. The shaders' code then runs in this process (docs/security.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/core/scratch_folder.hpp"
#include "host/executors/loop_guard.hpp"
#include "host/twin/scene_view.hpp"

namespace eyeray::engine::executors {

class TwinModule {
 public:
  // `folder`: laid over the embedded shaders; empty: none. A module that was made before comes from the
  // cache. InputError if a shader is not valid C++; Error (bad_input) if there is no compiler.
  TwinModule(const std::filesystem::path& folder, const std::string& sanitizers);
  ~TwinModule();
  TwinModule(const TwinModule&) = delete;
  TwinModule& operator=(const TwinModule&) = delete;

  const twin::Functions& functions() const { return *functions_; }
  // The name of its compiler, such as "g++".
  const std::string& compiler() const { return compiler_; }
  // Counts the loops of the shaders in `folder`.
  const LoopGuard& loops() const { return loops_; }
  // The shaders in `folder`.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::optional<ScratchFolder> scratch_;  // for files that the cache cannot hold
  LoopGuard loops_;
  std::vector<std::filesystem::path> files_;
  std::string compiler_;
  void* handle_ = nullptr;
  const twin::Functions* functions_ = nullptr;
};

}  // namespace eyeray::engine::executors
