// The options of commands that make a picture: render's and slurm's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/cli/command.hpp"
#include "host/session/request.hpp"

namespace eyeray::engine::cli {

// The most samples of a pixel that does not reach the noise that is wanted, where nothing else is set.
constexpr int most_samples_by_default = 1 << 14;

struct PictureOptions {
  SceneOptions scene;
  executors::ExecutorOptions executor;
  session::Request request;
  std::vector<std::string> outputs;  // none: the scene's name with .png, in the current folder
  bool classic = false;              // session::make_classic
  bool half = false;                 // write the colours of each .exr in 16 bits a channel

  void add_to(CLI::App& command);
  // Names the default output, and throws Error now for an output that could not be written later.
  void check_outputs();
  // The scene as it is to be rendered, and `request` for it.
  Scene load();

 private:
  void check_shard();
};

}  // namespace eyeray::engine::cli
