// The twin of a user's shaders: compiled as C++, with all that a debugger wants to know, into a shared object
// that this process loads. Their code then runs in it (docs/security.md).
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
  // `folder`: laid over the embedded shaders; empty: none. One that was made before is taken from the cache.
  // InputError where a shader is no C++; Error (bad_input) where there is no compiler.
  TwinModule(const std::filesystem::path& folder, const std::string& sanitizers);
  ~TwinModule();
  TwinModule(const TwinModule&) = delete;
  TwinModule& operator=(const TwinModule&) = delete;

  const twin::Functions& functions() const { return *functions_; }
  // "g++": its compiler.
  const std::string& compiler() const { return compiler_; }
  // Counts the loops of `folder`.
  const LoopGuard& loops() const { return loops_; }
  // The shaders in `folder`.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::optional<ScratchFolder> scratch_;  // files that the cache cannot take
  LoopGuard loops_;
  std::vector<std::filesystem::path> files_;
  std::string compiler_;
  void* handle_ = nullptr;
  const twin::Functions* functions_ = nullptr;
};

}  // namespace eyeray::engine::executors
