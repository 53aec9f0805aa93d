// From a scene file to picture files: what `render` does once, and `dev` again and again.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/cli/command.hpp"
#include "host/core/ray_counts.hpp"
#include "host/film/channel.hpp"
#include "host/program/json.hpp"

namespace eyeray::cli {

// What only renders that take long need.
struct LongRender {
  std::string checkpoint;          // where to begin one; empty: none
  std::string resume;              // the one to go on from, and to keep; empty: none
  double checkpoint_seconds = 30;  // between two of its writings
  int band_mebibytes = 256;        // RenderOptions::band_bytes
};

// Of a pixel that does not reach the noise that is wanted, where nothing else is said.
constexpr int most_samples_by_default = 1 << 14;

struct PictureRequest {
  SceneOptions scene;
  executors::Backend backend = executors::Backend::gpu;
  executors::ExecutorOptions executor;
  Rect crop;
  std::vector<std::string> outputs;  // none: the scene's name with .png, in the current folder
  film::Channels aovs;               // as files NAME.AOV.* or layers, NAME from the first output
  bool half = false;                 // the picture in each .exr
  LongRender long_render;
  bool ray_kinds = false;                   // count rays by kind
  bool classic = false;                     // sample as the published statistics of Haines' databases do
  double noise = 0;                         // RenderOptions::noise
  double clamp = 0;                         // RenderOptions::clamp
  std::optional<render::Shard> shard = {};  // of the picture only this share, as a part

  // The options that say all this.
  void add_to(CLI::App& command);
  // Names the default output, and throws Error now for an output that could not be written later.
  void check_outputs();
  // All that is written.
  std::vector<std::filesystem::path> files_to_write() const;

 private:
  void check_classic() const;
  void check_shard();
};

// How noisy a picture is that was rendered until it is not.
struct Noise {
  double wanted = 0;    // at most
  double greatest = 0;  // of a pixel
  double share = 0;     // of the pixels that are as wanted
};

struct Picture {
  std::vector<std::filesystem::path> files;    // written
  std::vector<std::filesystem::path> sources;  // read: the scene's files and the shaders from --shaders
  std::string device;                          // Executor::description()
  std::shared_ptr<executors::OpenDevice> open_device;  // for pictures to come; null of a CPU's
  Rect crop;                                           // what was rendered
  std::optional<render::Shard> shard;                  // of it only this share …
  int64_t pixels = 0;                                  // … of so many
  size_t parts = 0;                                    // of which it was merged; 0 where it was rendered
  int samples = 0;                                     // a pixel, asked for
  int samples_done = 0;
  uint64_t rays = 0;
  double sampling_seconds = 0;
  double sampling_processor_seconds = 0;  // of all threads together
  double seconds = 0;                     // all in all
  uint64_t flagged_pixels = 0;
  uint64_t flagged_hits = 0;  // of the AOVs; 0 if none is made of first hits
  uint32_t flags = 0;         // of either
  bool interrupted = false;
  int bands = 1;                       // of rows, in which it was rendered
  double share = 0;                    // of all samples that were taken
  int most_samples = 0;                // of a pixel; samples_done where all have the same
  double mean_samples = 0;             // of all pixels
  std::optional<Noise> noise;          // where it was asked for
  double clamp = 0;                    // PictureRequest::clamp …
  uint64_t clamped = 0;                // … and the samples of this run that it changed
  uint64_t fireflies = 0;              // of this run, render::Fireflies
  uint64_t samples_resumed = 0;        // of pixels, taken from a checkpoint
  uint64_t rays_resumed = 0;           // of `rays`, those behind samples_resumed
  std::filesystem::path checkpoint;    // left behind, to go on from; empty: none
  std::optional<RayCounts> ray_kinds;  // of this run, where they were asked for
  std::vector<std::string> warnings;   // render::warnings_of
  StageTimes times;
};

// Loads, renders and writes. `files` is empty when it was interrupted before every pixel had a sample, and,
// for a picture of several bands, before all had all.
Picture make_picture(PictureRequest request, const std::function<void(const render::Progress&)>& progress);
// The same of a share: `request.shard` and its one output.
Picture make_part(PictureRequest request, const std::function<void(const render::Progress&)>& progress);
// "whitted.png: 640×480, 4 samples a pixel, 1200000 rays in 0.35 s (3.43 Mrays/s), 0.8 s in all, on gpu: …".
// The rays divided by their seconds are the rate.
std::string summary(const Picture& picture);
// "load 1.2 ms, compile 30 ms, …".
std::string stages(const StageTimes& times);
Json to_json(const Picture& picture);

}  // namespace eyeray::cli
