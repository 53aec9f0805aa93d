// The files that `eyeray generate` writes: a scene, and perhaps its mesh beside it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "host/generate/mesh_sink.hpp"

namespace eyeray::engine::cli {

struct GenerateOutput {
  std::filesystem::path scene;
  bool force = false;
  bool json = false;

  std::filesystem::path mesh() const { return std::filesystem::path(scene).replace_extension(".ply"); }
};

struct Count {
  std::string_view what;
  uint64_t number;
};

struct Generated {
  std::string recipe = {};         // the words after `eyeray generate` that make the same files again
  std::vector<Count> counts = {};  // the numbers of the scene file's entries
  std::string scene = {};
  std::function<void(generate::MeshSink&)> mesh = {};  // empty: none
  std::string mesh_keys = {};                          // the keys of its [[mesh]], except `file`
};

// Error (bad_input) for more triangles than a mesh may have.
void check_triangles(double triangles);

// Writes the mesh, then the scene, so that no scene names a missing mesh, and prints a summary. `make` is
// called once the files are known to be writable. Error (file_io) if they are not writable, or, unless
// forced, if eyeray generate did not make them.
void write_generated(const GenerateOutput& output, bool with_mesh, const std::function<Generated()>& make);

}  // namespace eyeray::engine::cli
