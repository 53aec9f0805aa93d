// One interface over the three executors.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/pixel.hpp"
#include "host/core/ray_tree.hpp"
#include "host/core/rect.hpp"
#include "host/core/stopwatch.hpp"
#include "host/executors/profile_options.hpp"
#include "host/pack/options.hpp"
#include "host/scene/photons.hpp"
#include "host/scene/query.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::executors {

class OpenDevice;
class Tunables;

enum class Backend { gpu, twin, reference };
// "gpu", "twin", "reference", both ways; Error (bad_input) for another name.
Backend parse_backend(std::string_view name);
std::string_view backend_name(Backend backend);

// A sample, and how it came about.
struct Probed {
  PixelSample sample;
  RayTree rays;
};

// Produces samples of pixels of one scene. Not thread-safe; parallel inside.
class Executor {
 public:
  virtual ~Executor() = default;

  // Sample `index` of every pixel of `tile`, row by row; out.size() = tile.pixels(). `auxiliaries`: what a
  // denoiser asks of the same samples, as many or none; only where paths walk at random
  // (scene/integrator.hpp). Returns false when interrupted, and both are then undefined.
  virtual bool sample(const Rect& tile, uint32_t index, std::span<PixelSample> out,
                      std::span<AuxiliarySample> auxiliaries = {}) = 0;
  // The same of every stride-th pixel of every stride-th row of the picture, from its top left on: how it
  // will look, soon. out.size() = ⌈width / stride⌉ · ⌈height / stride⌉. False too where there is no such
  // thing.
  virtual bool coarse_sample(int /*stride*/, uint32_t /*index*/, std::span<PixelSample> /*out*/) {
    return false;
  }
  // What the ray through the centre of every pixel of `tile` hits; out.size() = tile.pixels().
  virtual void first_hits(const Rect& tile, std::span<FirstHit> out) = 0;

  // Sample `index` of one pixel, and what is to be seen along its rays. Positions are the shaders', relative
  // to the eye, but the reference's. Only where ExecutorOptions::ray_kinds.
  virtual Probed probe(int x, int y, uint32_t index) = 0;
  // What the random path of that sample decides, event by event (shaders/integrators/trail.glsl); empty where
  // unknown. From many threads at once.
  virtual std::vector<uint32_t> events(int /*x*/, int /*y*/, uint32_t /*index*/) const { return {}; }

  // Where a scene's integrator sends out photons: the ways of those of sample `index`; else nothing.
  virtual std::vector<PhotonWay> photon_ways(uint32_t /*index*/) { return {}; }
  // From now on these photons of each sample bring no light: lists by sample, in order.
  virtual void leave_out(std::vector<std::vector<uint32_t>> /*photons*/) {}

  // Samples are from now on by the values that ExecutorOptions::tunables have now.
  virtual void reload_tunables() {}

  // What each ray hits, and the seconds that tracing alone took: by the device's clock where it has one,
  // without the copying of rays and hits. hits.size() = batch.rays.size().
  virtual double query(const QueryBatch& batch, std::span<QueryHit> hits) = 0;

  // Bytes that the scene's geometry and the BVHs over it take; 0 where unknown.
  virtual uint64_t geometry_bytes() const { return 0; }

  // For people: "gpu: llvmpipe (LLVM 15.0.6, 256 bits), driver …", "twin: 2 threads".
  virtual std::string description() const = 0;
  // What of the device decides bits, as its self-test found it: where that is the same, so are the samples of
  // the same program. A device whose arithmetic is not exact is named with its driver.
  virtual std::string arithmetic() const { return "of the program itself"; }
  // The device that it is on, for executors to come (ExecutorOptions::open_device); null of a CPU's.
  virtual std::shared_ptr<OpenDevice> device() const { return nullptr; }
  // Shader files read from ExecutorOptions::shader_folder, for a watcher.
  virtual std::vector<std::filesystem::path> source_files() const { return {}; }
  // Stages spent so far, construction included.
  const StageTimes& times() const { return times_; }

 protected:
  StageTimes times_;
};

struct ExecutorOptions {
  std::string device = "auto";          // auto | cpu | gpu | INDEX | part of a NAME
  std::filesystem::path shader_folder;  // laid over the embedded shaders, file by file; empty: none
  bool fast_math = false;               // gpu: let the driver contract and re-associate
  bool validate_spirv = false;          // gpu: what a kernel was compiled to, before the driver gets it
  std::string validation;               // gpu: "", "core" or "sync"
  double timeout_seconds = 60;          // gpu: the longest wait for one dispatch
  double least_compile_seconds = 0;     // gpu: if that is more, the longest that a kernel may compile
  pack::PackOptions pack;               // all: `acceleration`; gpu and twin: the rest
  ProfileOptions profile;               // gpu
  bool ray_kinds = false;               // gpu: count reflected and refracted rays; the others always do
  bool search_cost = false;             // gpu: FirstHit::cost; the twin always counts, the reference never
  bool constants = true;                // gpu: compile the primitives of a small scene into the kernel
  bool formula_numbers = false;         // gpu: kernels load the numbers of formulas, and suit others too
  bool optimise = true;                 // gpu: give the driver an optimised kernel
  bool wide_vectors = true;             // gpu: where the picture wants them (trace_plan.hpp)
  bool sets_environment = true;         // gpu: DeviceOptions::sets_environment
  std::shared_ptr<OpenDevice> open_device;  // gpu: taken as it is, and left open; null: one of its own
  std::shared_ptr<Tunables> tunables;       // gpu: constants of shaders that move; null: none do
  bool compile_twin = false;                // twin: compile shader_folder's files as C++ (twin_module.hpp)
  std::string sanitizers;                   // twin, with compile_twin: as -fsanitize takes them
};

// Whether so many samples repay kernels that have the scene inside, where kernels without it would do for
// the next scene too.
bool repay_kernels(int64_t samples);
// For scenes that come one after the other and differ in what moved, each a picture of so many samples:
// their BVHs are refitted where that will do, and they share kernels where samples do not repay others.
ExecutorOptions for_frames(ExecutorOptions options, int64_t samples);

// For ExecutorOptions::open_device. Error (no_device) when no device will do.
std::shared_ptr<OpenDevice> open_device(const ExecutorOptions& options);

// Error (no_device) when `backend` is gpu and no device will do; InputError for a shader that does not
// compile.
std::unique_ptr<Executor> make_executor(Backend backend, const Scene& scene, const ExecutorOptions& options);

}  // namespace eyeray::executors
