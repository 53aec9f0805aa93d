// One interface over the three executors.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/grid.hpp"
#include "host/core/pixel.hpp"
#include "host/core/ray_tree.hpp"
#include "host/core/stopwatch.hpp"
#include "host/emulator/finding.hpp"
#include "host/executors/made_kernel.hpp"
#include "host/executors/options.hpp"
#include "host/scene/query.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::executors {

enum class Backend { gpu, twin, reference, emulator };
// Convert between a backend and its name: "gpu", "twin", "reference" or "emulator". Error (bad_input) for
// another name.
Backend parse_backend(std::string_view name);
std::string_view backend_name(Backend backend);

// A sample, and how it came about.
struct Probed {
  PixelSample sample;
  RayTree rays;
};

// Facts about an executor, beside its samples.
struct ExecutorFacts {
  // For people: "gpu: llvmpipe (LLVM 15.0.6, 256 bits), driver …", "twin: 2 threads".
  std::string description;
  // The properties of the device that decide bits, as found by its self-test: if they are equal, the samples
  // of the same program are equal. A device whose arithmetic is not exact is named with its driver.
  std::string arithmetic = "of the program itself";
  // The device that the executor runs on, for later executors (GpuOptions::open_device); null for one on the
  // CPU.
  std::shared_ptr<OpenDevice> device;

  // Seconds of the longest dispatch of photons or of a tile so far; 0 without a device.
  double longest_dispatch = 0;

  std::vector<emulator::Finding> findings;  // faults that the emulator found

  // The next two grow as kernels are made. Some kernels are made only when they are first needed.
  uint64_t geometry_bytes = 0;                      // bytes of geometry and the BVHs over it; 0 where unknown
  std::vector<std::filesystem::path> source_files;  // read from the folder of shaders, for a watcher
  std::vector<MadeKernel> kernels;                  // only if GpuOptions::examines_kernels
};

// Produces samples of pixels of one scene. Not thread-safe; parallel inside.
class Executor {
 public:
  virtual ~Executor() = default;

  // Sample `index` of every pixel of `grid`, row by row; out.size() = grid.pixels(). `auxiliaries`: a
  // denoiser's inputs for the same samples, one for each; or empty. They are available only if paths walk at
  // random (scene/integrator.hpp). Returns false when interrupted, and both are then undefined.
  virtual bool sample(const Grid& grid, uint32_t index, std::span<PixelSample> out,
                      std::span<AuxiliarySample> auxiliaries = {}) = 0;
  // The first hit of the ray through the centre of every pixel of `tile`. out.size() = tile.pixels().
  virtual void first_hits(const Rect& tile, std::span<FirstHit> out) = 0;
  // Sample `index` of one pixel, and the values along its rays. Positions are the shaders', relative to the
  // eye; the reference's are not. Requires ExecutorOptions::ray_kinds.
  virtual Probed probe(int x, int y, uint32_t index) = 0;
  // Writes the hit of each ray, and returns the seconds that tracing alone took: by the device's clock where
  // it has one, without the copying of rays and hits. hits.size() = batch.rays.size().
  virtual double query(const QueryBatch& batch, std::span<QueryHit> hits) = 0;

  const ExecutorFacts& facts() const { return facts_; }
  // Stages spent so far, construction included.
  const StageTimes& times() const { return times_; }

 protected:
  ExecutorFacts facts_;
  StageTimes times_;
};

// Error (no_device) when `backend` is gpu and no device will do; InputError for a shader that does not
// compile.
std::unique_ptr<Executor> make_executor(Backend backend, const Scene& scene, const ExecutorOptions& options);

}  // namespace eyeray::engine::executors
