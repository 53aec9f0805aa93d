// The stages of denoising as kernels on a Vulkan device (shaders/kernels/denoise.comp.glsl).
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>

#include "host/denoise/stages.hpp"
#include "host/executors/open_device.hpp"
#include "host/executors/shader_files.hpp"
#include "host/gpu/dispatch_size.hpp"
#include "host/gpu/kernel_compiler.hpp"

#include "shaders/denoise/step.h"

namespace eyeray::engine::denoise_kernels {

class DeviceStages final : public denoise::Stages {
 public:
  // `options`: those that the device was opened with. The kernels are compiled when they are first needed:
  // InputError for a shader of the folder that does not compile.
  DeviceStages(std::shared_ptr<executors::OpenDevice> device, const executors::ExecutorOptions& options);

  // Error (interrupted) after Ctrl-C, too.
  void average(const denoise::NoisyFeatures& features, denoise::Planes& means) override;
  void fit(const denoise::NoisyColors& colors, denoise::Halves& careful, denoise::Halves& bold) override;

 private:
  struct Tile {
    int x, y, width, height;
  };
  // The inputs of one half in a window: values that are averaged or fitted, and those that pixels are
  // compared by.
  struct Window {
    int radius;
    float least;
    const denoise::Planes& compared;
    const denoise::Planes& variances;
    const denoise::Planes& valid;
    const denoise::Planes& values;
  };

  // A kernel, and how many invocations to dispatch at a time.
  struct Stage {
    std::string defines;
    std::shared_ptr<gpu::Kernel> kernel;
    gpu::DispatchSize size;
  };

  // Calls body(tile) for the picture's tiles, and report(share) after each row of them. Every stage can
  // compute a neighbour of a whole tile at once. `last`: the last stage.
  template <typename Report, typename Body>
  void for_each_tile(const denoise::Planes& planes, const std::string& last, const Report& report,
                     const Body& body);
  // Computes the distances of the tile's pixels, and uploads the values.
  void compare(const Window& window, const Tile& tile);
  // Runs a stage, with `rows` rows of `columns` invocations for each of so many neighbours.
  void run(const std::string& defines, int columns, int rows, int neighbours);
  // The stage of a define, and of more lines of defines.
  Stage& stage(const std::string& defines);
  gpu::Buffer& buffer(uint32_t binding, size_t bytes);
  // Copies the tile and its margin.
  void upload(uint32_t binding, const denoise::Planes& planes, const Tile& tile);
  // Copies planes of the tile, from plane `first` of the results on.
  void read(int first, const Tile& tile, denoise::Planes& planes);

  static constexpr uint32_t bindings = 8;

  std::shared_ptr<executors::OpenDevice> device_;
  gpu::KernelOptions how_;
  executors::ShaderFiles files_;
  std::list<Stage> stages_;
  std::optional<gpu::Buffer> buffers_[bindings];
  shader::DenoiseStep step_{};
};

// The stages by the device, or by the processor if that is as fast or there is no device (null). `options`:
// those of the executor. ProfileOptions::denoise may choose another way.
std::unique_ptr<denoise::Stages> make_stages(std::shared_ptr<executors::OpenDevice> device,
                                             const executors::ExecutorOptions& options);

}  // namespace eyeray::engine::denoise_kernels
