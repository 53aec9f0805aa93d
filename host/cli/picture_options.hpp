// The options of commands that make a picture: render's and slurm's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/cli/command.hpp"
#include "host/session/request.hpp"

namespace eyeray::engine::cli {

// The default for the most samples of a pixel, at which it stops even if it has not reached the wanted noise.
constexpr int most_samples_by_default = 1 << 14;

struct PictureOptions {
  SceneOptions scene;
  executors::ExecutorOptions executor;
  session::Request request;
  std::vector<std::string> outputs;  // empty: the scene's name with .png, in the current folder
  bool classic = false;              // session::make_classic
  bool half = false;                 // write the colours of each .exr in 16 bits a channel

  void add_to(CLI::App& command);
  // Names the default output, and throws Error now for an output that could not be written later.
  void check_outputs();
  // Loads the scene as it is to be rendered, and adapts `request` to it.
  Scene load();

 private:
  void check_shard();
};

}  // namespace eyeray::engine::cli
