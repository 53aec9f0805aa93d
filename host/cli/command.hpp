// The commands, each in its own file. Each adds its subcommand to the app. When the user names it, CLI11
// fills the options, and the command's `run` is called and returns the exit code. Errors are thrown; main
// prints them.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/core/error.hpp"
#include "host/core/rect.hpp"
#include "host/loader/scene_file.hpp"
#include "host/program/bar.hpp"
#include "host/program/integers.hpp"
#include "host/render/render.hpp"
#include "host/scene/scene.hpp"

namespace CLI {
class App;  // <CLI/CLI.hpp> compiles for a second or more: include it in .cpp files with options only
}

namespace eyeray::engine::cli {

using namespace program;

// Set by the command that was named.
using Run = std::function<ExitCode()>;

void add_render(CLI::App& app, Run& run);
void add_verify(CLI::App& app, Run& run);
void add_run(CLI::App& app, Run& run);
void add_compare(CLI::App& app, Run& run);
void add_probe(CLI::App& app, Run& run);
void add_check(CLI::App& app, Run& run);
void add_devices(CLI::App& app, Run& run);
void add_dev(CLI::App& app, Run& run);
void add_generate(CLI::App& app, Run& run);
void add_shaders(CLI::App& app, Run& run);
void add_kernels(CLI::App& app, Run& run);
void add_merge(CLI::App& app, Run& run);
// `sbatch_words`: the words after --.
void add_slurm(CLI::App& app, Run& run, const std::vector<std::string>& sbatch_words);
void add_new(CLI::App& app, Run& run);
// These commands describe `app` itself, to which all commands are added before they run.
void add_completion(CLI::App& app, Run& run);
void add_manual(CLI::App& app, Run& run);

// SCENE and the options of the command line that change it: -D, --allow-path, -s, --spp, --integrator,
// --seed, --triangle, --max-depth, --transparent.
class SceneOptions {
 public:
  void add_to(CLI::App& command);
  // The scene with the options laid over it; prints its warnings on stderr. InputError or Error as
  // load_scene.
  Scene load() const;
  bool gives_samples() const { return !values_[0].empty(); }
  // The options that were given, to be pasted into another command: " -s 96x72 --spp 4".
  std::string as_written() const;
  const std::string& file() const { return file_; }
  // The values of -D.
  const std::vector<std::string>& defines() const { return defines_; }
  // These options, with more values that override the scene's.
  SceneOptions with_defines(const std::vector<std::string>& defines) const {
    SceneOptions options = *this;
    options.defines_.insert(options.defines_.end(), defines.begin(), defines.end());
    return options;
  }
  // These options for a mesh alone that turns once in so many frames.
  SceneOptions with_turntable(int frames) const {
    SceneOptions options = *this;
    options.turntable_ = std::to_string(frames);
    return options;
  }
  // These options for another scene.
  SceneOptions for_file(const std::string& file) const {
    SceneOptions options = *this;
    options.file_ = file;
    return options;
  }

 private:
  std::string file_;
  std::vector<std::string> defines_;
  loader::Trust trust_;
  std::string turntable_, size_;
  bool transparent_ = false;
  std::array<std::string, 8>
      mesh_values_;                    // the values of the options for a mesh alone, in options.cpp's table
  std::array<std::string, 8> values_;  // the values of the options in options.cpp's table, --spp first
};

// The allowed values of an option that overrides a choice in the scene (--integrator, --triangle); empty for
// other options.
std::vector<std::string> value_choices(std::string_view option);

// Reads "3,4" as {3, 4}; Error (bad_input) for anything else.
std::pair<int, int> parse_pixel(const std::string& text);

// --device, --timeout, --fast-math, --tune, --validate.
void add_device_options(CLI::App& command, executors::ExecutorOptions& options);
// These, --shaders, --compile-twin and --sanitize.
void add_executor_options(CLI::App& command, executors::ExecutorOptions& options);

// Reads a list such as "gpu,twin", which names no backend twice; Error (bad_input) for anything else.
std::vector<executors::Backend> parse_backends(const std::string& list);

// --backend gpu|twin|reference.
void add_backend_option(CLI::App& command, executors::Backend& backend);

// --crop X,Y,W,H; an empty rect when not given.
void add_crop_option(CLI::App& command, Rect& crop);

// Progress on stderr: a bar with rays/s and time left on a terminal, a plain line every few seconds
// otherwise, nothing under --quiet. NO_COLOR is honoured. Call it with Progress() before making the executor:
// a terminal then shows that kernels compile.
std::function<void(const render::Progress&)> progress_reporter(bool quiet);

}  // namespace eyeray::engine::cli
