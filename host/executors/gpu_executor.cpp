// The shaders on a Vulkan device.
#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/core/termination.hpp"
#include "host/executors/executors.hpp"
#include "host/executors/gpu_queries.hpp"
#include "host/executors/loop_budget.hpp"
#include "host/executors/open_device.hpp"
#include "host/executors/photon_kernel.hpp"
#include "host/executors/profile.hpp"
#include "host/executors/samples.hpp"
#include "host/executors/scene_facts.hpp"
#include "host/executors/scene_kernels.hpp"
#include "host/executors/shader_probe.hpp"
#include "host/executors/specialise.hpp"
#include "host/executors/tile_size.hpp"
#include "host/executors/trace_plan.hpp"
#include "host/executors/wavefront.hpp"
#include "host/executors/workgroups.hpp"
#include "host/gpu/command_list.hpp"
#include "host/pack/collapse.hpp"
#include "host/pack/pack.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::engine::executors {
namespace {

class GpuExecutor final : public Executor {
 public:
  GpuExecutor(const Scene& scene, records::PackedScene packed, std::shared_ptr<OpenDevice> open_device,
              const StageTimes& times, const ExecutorOptions& options)
      : options_(options),
        eye_(scene.camera.eye),
        open_device_(std::move(open_device)),
        device_(open_device_->device()),
        profile_(choose_profile(options.gpu.profile, device_.info())),
        uploaded_(device_, profile_.texel_buffers),
        sample_size_(device_.info()),
        auxiliary_size_(device_.info()),
        hit_size_(device_.info()) {
    times_ = times;
    facts_.description = description();
    facts_.arithmetic = arithmetic();
    facts_.device = open_device_;
    const uint32_t lanes = device_.info().limits.subgroup_size;
    const TracePlan plan = plan_tracing(profile_, options.gpu.profile, scene.image, packed, lanes);
    workgroups_.subgroup = lanes;
    if (device_.info().type == gpu::DeviceType::cpu)
      workgroups_.stride = std::max(1u, std::thread::hardware_concurrency());

    make_kernels_for(packed, plan);
    times_.measure("upload", [&] {
      for (const SceneBuffer& buffer : scene_buffers(packed)) uploaded_.add(buffer);
    });
    queries_.emplace(device_, *kernels_, plan, workgroups_, eye_);
    if (sends_photons(scene.render.integrator))
      photons_.emplace(device_, *kernels_, times_, workgroups_, photon_settings(scene), eye_);
    if (plan.wavefront)
      make_wavefront(packed, plan);
    else
      sample_kernel_ = kernels_->make("kernels/render.comp.glsl");
    if (options.gpu.examines_kernels) make_rare_kernels(scene.render.integrator);
    check_validation();
  }

  bool sample(const Grid& grid, uint32_t index, std::span<PixelSample> out,
              std::span<AuxiliarySample> auxiliaries) override {
    if (!send_out_photons(index)) return false;
    const auto trace = [&](const shader::Dispatch& push, gpu::Buffer& output) {
      return wavefront_ ? wavefront_->run(push, output) : dispatch(*sample_kernel_, push, output);
    };
    return for_tiles<shader::SampleResult>(grid, index, sample_size_, trace,
                                           [&](size_t first, auto results) { take(results, first, out); }) &&
           (auxiliaries.empty() || sample_auxiliaries(grid, index, auxiliaries));
  }

  void first_hits(const Rect& tile, std::span<FirstHit> out) override {
    make_hit_kernel();
    const auto trace = [&](const shader::Dispatch& push, gpu::Buffer& output) {
      return dispatch(*hit_kernel_, push, output);
    };
    for_tiles<shader::HitResult>(tile, 0, hit_size_, trace, [&](size_t first, auto results) {
      for (size_t i = 0; i < results.size(); ++i) {
        check_traced(results[i].flags, device_.info().driver_version);
        out[first + i] = to_first_hit(results[i], eye_, options_.search_cost);
      }
    });
  }

  // Uses the loop of kernels/render.comp.glsl, even if the picture uses a wavefront; both have the same bits.
  Probed probe(int x, int y, uint32_t index) override {
    CHECK(options_.ray_kinds);
    const std::string entry = "kernels/render.comp.glsl";
    const ShaderProbe probe(kernels_->source(entry).files);
    const std::shared_ptr<gpu::Kernel> kernel = kernels_->make(entry, probe.defines());
    if (!send_out_photons(index)) stop_if_interrupted();
    gpu::Buffer records(device_, ShaderProbe::capacity * sizeof(shader::ProbeRecord), "probe");
    kernel->set_buffer(BINDING_PROBE, records);
    const auto trace = [&](const shader::Dispatch& push, gpu::Buffer& output) {
      return dispatch(*kernel, push, output);
    };
    Probed result;
    TileSize size(device_.info());
    for_tiles<shader::SampleResult>(Rect{x, y, 1, 1}, index, size, trace, [&](size_t, auto results) {
      result.sample = to_sample(results[0], true);
    });
    stop_if_interrupted();
    result.rays = probe.tree(records.read_records<shader::ProbeRecord>(ShaderProbe::capacity));
    return result;
  }

  double query(const QueryBatch& batch, std::span<QueryHit> hits) override {
    const double seconds = queries_->ask(batch, hits);
    check_validation();
    return seconds;
  }

 private:
  std::string description() const {
    const gpu::DeviceInfo& info = device_.info();
    const std::string text =
        options_.gpu.emulate
            ? fmt::format("emulator: the kernels for {}, {}", info.name, info.driver_version)
            : fmt::format("gpu: {}, {}; {}", info.name, info.driver_version, describe(profile_));
    return is_exact() ? text : text + "; arithmetic not exact, " + kept_numbers();
  }

  bool is_exact() const {
    const gpu::DeviceFacts& facts = open_device_->facts();
    const bool divides_exactly = facts.exact_division || options_.gpu.division != Division::own;
    return facts.exact_arithmetic && divides_exactly && !options_.gpu.fast_math;
  }

  std::string kept_numbers() const {
    const auto kept = [](bool is) { return is ? "kept" : "lost"; };
    const gpu::DeviceFacts& facts = open_device_->facts();
    return fmt::format("denormals {}, infinities {}", kept(facts.denormals_kept),
                       kept(facts.infinities_kept));
  }

  std::string arithmetic() const {
    const gpu::DeviceFacts& facts = open_device_->facts();
    std::string text = kept_numbers();
    if (facts.loop_cap) text += fmt::format(", loops end after {} iterations", facts.loop_iterations);
    if (is_exact()) return "exact, " + text;
    return fmt::format("not exact, {}, on {}, {}", text, device_.info().name, device_.info().driver_version);
  }

  void make_hit_kernel() {
    if (!hit_kernel_) hit_kernel_ = kernels_->make("kernels/render.comp.glsl", "#define FIRST_HITS\n");
  }
  void make_auxiliary_kernel() {
    if (!auxiliary_kernel_)
      auxiliary_kernel_ = kernels_->make("kernels/render.comp.glsl", "#define AUXILIARY\n");
  }
  // Makes the kernels that are made when they are first needed.
  void make_rare_kernels(IntegratorType integrator) {
    make_hit_kernel();
    if (walks_at_random(integrator)) make_auxiliary_kernel();
    queries_->make_kernels();
  }

  // Uses the loop of kernels/render.comp.glsl, even if the picture uses a wavefront.
  bool sample_auxiliaries(const Grid& grid, uint32_t index, std::span<AuxiliarySample> out) {
    make_auxiliary_kernel();
    const auto trace = [&](const shader::Dispatch& push, gpu::Buffer& output) {
      return dispatch(*auxiliary_kernel_, push, output);
    };
    return for_tiles<shader::AuxiliaryResult>(
        grid, index, auxiliary_size_, trace, [&](size_t first, auto results) {
          for (size_t i = 0; i < results.size(); ++i) {
            check_traced(results[i].flags, device_.info().driver_version);
            out[first + i] = to_auxiliary(results[i]);
          }
        });
  }

  // Emits the photons of sample `index`, if the integrator gathers photons. Returns false if interrupted.
  bool send_out_photons(uint32_t index) {
    if (!photons_) return true;
    const bool sent = photons_->send_out(index, options_.left_out.of(index));
    facts_.longest_dispatch = std::max(facts_.longest_dispatch, photons_->longest_dispatch());
    return sent;
  }

  // Converts results into samples, from out[first] on.
  void take(std::span<const shader::SampleResult> results, size_t first, std::span<PixelSample> out) {
    constexpr size_t piece = 4096;
    parallel_for(0, int((results.size() + piece - 1) / piece), [&](int p) {
      const size_t begin = size_t(p) * piece, end = std::min(results.size(), begin + piece);
      for (size_t i = begin; i < end; ++i) {
        out[first + i] = to_sample(results[i], options_.ray_kinds);
        if (photons_) out[first + i].flags |= photons_->flags();
      }
    });
  }

  void make_kernels_for(records::PackedScene& packed, const TracePlan& plan) {
    Specialisation specialisation;
    specialisation.constants = options_.gpu.constants && profile_.constants;
    specialisation.profile = profile_;
    specialisation.ray_kinds = options_.ray_kinds;
    specialisation.search_cost = options_.search_cost;
    specialisation.subgroup_size = workgroups_.subgroup;
    specialisation.group_stride = workgroups_.stride;
    expression::LoadedNumbers numbers;
    if (options_.gpu.formula_numbers && !packed.formulas.empty()) specialisation.formula_numbers = &numbers;
    if (open_device_->facts().loop_cap)
      specialisation.loop_budget = loop_budget_of(packed, device_.info().driver_version);
    // A copy of the nodes, made before the nodes for packets are appended to them.
    RawVector<shader::uvec4> nodes =
        plan.incoherent == Rays::cooperative ? packed.nodes : RawVector<shader::uvec4>();
    if (plan.coherent == Rays::packets)
      specialisation.packet_bvh =
          times_.measure("collapse", [&] { return pack::add_packet_bvh(packed, workgroups_.subgroup); });

    gpu::KernelOptions how = kernel_options(options_.gpu, *open_device_);
    how.flatten = profile_.flatten;
    // A capped driver grants 65 535 iterations to all loops together (docs/lavapipe.md).
    const uint32_t most_iterations = open_device_->facts().loop_cap ? 50'000 : LoopGuard().most();
    kernels_.emplace(
        SceneKernels::Workshop{*open_device_, times_, facts_, how, options_.gpu.tunables.get(),
                               most_iterations, options_.ray_kinds, options_.gpu.examines_kernels},
        uploaded_, ShaderFiles(options_.shader_folder, specialise(packed, specialisation)));
    if (specialisation.formula_numbers) uploaded_.add(formula_numbers_buffer(numbers.words()));
    if (!nodes.empty()) kernels_->make_bvh4_of(std::move(nodes), packed.bvhs[0]);
  }

  void make_wavefront(const records::PackedScene& packed, const TracePlan& plan) {
    WavefrontOptions options;
    options.shadow_rays = shadow_rays(packed);
    options.bounces = most_bounces(packed);
    options.splits = splits(packed);
    options.bounced = plan.bounced;
    options.workgroups = workgroups_;
    wavefront_.emplace(
        device_,
        [&](const std::string& entry, const std::string& defines) { return kernels_->make(entry, defines); },
        options);
  }

  // Calls trace(push, output) for the grid's pixels, tile by tile, and take(first, results) with the results
  // of consecutive pixels and the index of the first. `size` belongs to the kernel. Returns false when
  // interrupted.
  template <typename Result, typename Trace, typename Take>
  bool for_tiles(const Grid& grid, uint32_t index, TileSize& size, const Trace& trace, const Take& take) {
    const auto width = size_t(grid.width());
    int x = 0;
    for (int y = 0; y < grid.height();) {
      if (interrupted()) return false;
      const Rect tile = size.next(grid, x, y);
      const auto pixels = size_t(tile.pixels());
      gpu::Buffer& output = output_for(pixels * sizeof(Result));
      shader::Dispatch push{};
      push.tile_x = uint32_t(grid.area.x + tile.x * grid.stride);
      push.tile_y = uint32_t(grid.area.y + tile.y * grid.stride);
      push.tile_width = uint32_t(tile.width);
      push.tile_height = uint32_t(tile.height);
      push.sample_index = index;
      push.count = uint32_t(pixels);
      push.stride = uint32_t(grid.stride);
      const std::optional<double> seconds = kernels_->run([&] { return trace(push, output); });
      if (!seconds) return false;
      times_.add("dispatch", *seconds);
      facts_.longest_dispatch = std::max(facts_.longest_dispatch, *seconds);
      size.took(grid, tile, *seconds);

      times_.measure("read-back", [&] {
        const std::byte* bytes = output.read(pixels * sizeof(Result)).data();
        const std::span results(reinterpret_cast<const Result*>(bytes), pixels);
        kernels_->check_loops(results);
        const size_t run = tile.width == grid.width() ? pixels : size_t(tile.width);
        for (size_t begin = 0; begin < pixels; begin += run)
          take((size_t(tile.y) + begin / size_t(tile.width)) * width + size_t(tile.x),
               results.subspan(begin, run));
      });
      x += tile.width;
      if (x == grid.width()) x = 0, y += tile.height;
    }
    check_validation();
    facts_.findings = device_.findings();
    return true;
  }

  // Runs kernels/render.comp.glsl for a whole tile.
  std::optional<double> dispatch(gpu::Kernel& kernel, const shader::Dispatch& push, gpu::Buffer& output) {
    kernel.set_buffer(BINDING_OUTPUT, output);
    if (photons_) photons_->bind(kernel);
    const gpu::RunTime time =
        gpu::dispatch(device_, kernel, std::as_bytes(std::span(&push, 1)),
                      {workgroups_.of_items(Workgroups::pixels(push.tile_width, push.tile_height)), 1, 1});
    times_.add("pipeline", time.compile_seconds);
    return time.seconds;
  }

  gpu::Buffer& output_for(size_t bytes) {
    if (!output_ || output_->size() < bytes) output_.emplace(device_, bytes, "results");
    return *output_;
  }

  // Under --validate, any message is a failure.
  void check_validation() const {
    const std::vector<std::string> messages = device_.validation_messages();
    if (!messages.empty())
      throw Error(ExitCode::no_device, "{} messages of the validation layer, the first: {}", messages.size(),
                  messages[0]);
  }

  ExecutorOptions options_;
  Vec3 eye_;
  std::shared_ptr<OpenDevice> open_device_;
  gpu::Device& device_;
  Profile profile_;
  UploadedScene uploaded_;
  std::optional<gpu::Buffer> output_;
  Workgroups workgroups_;
  std::optional<SceneKernels> kernels_;
  std::optional<GpuQueries> queries_;
  std::optional<PhotonKernel> photons_;                         // null if the integrator gathers none
  std::optional<Wavefront> wavefront_;                          // makes the samples, if it is set,
  std::shared_ptr<gpu::Kernel> sample_kernel_;                  // else this kernel makes them
  std::shared_ptr<gpu::Kernel> auxiliary_kernel_, hit_kernel_;  // null until they are asked for
  TileSize sample_size_, auxiliary_size_, hit_size_;
};

}  // namespace

std::unique_ptr<Executor> make_gpu_executor(const Scene& scene, const ExecutorOptions& options) {
  StageTimes times;
  records::PackedScene packed = times.measure("pack", [&] { return pack::pack(scene, options.pack); });
  const GpuOptions& gpu = options.gpu;
  std::shared_ptr<OpenDevice> device = gpu.emulate ? nullptr : gpu.open_device;
  if (!device) {
    const bool wide = gpu.wide_vectors && wants_wide_vectors(gpu.profile, scene.image, packed);
    device = std::make_shared<OpenDevice>(gpu, wide, times);
  }
  return std::make_unique<GpuExecutor>(scene, std::move(packed), std::move(device), times, options);
}

}  // namespace eyeray::engine::executors
