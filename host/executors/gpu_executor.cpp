// The shaders on a Vulkan device.
#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "host/core/error.hpp"
#include "host/core/free_memory.hpp"
#include "host/core/parallel_for.hpp"
#include "host/core/termination.hpp"
#include "host/executors/executors.hpp"
#include "host/executors/fault.hpp"
#include "host/executors/profile.hpp"
#include "host/executors/samples.hpp"
#include "host/executors/scene_buffers.hpp"
#include "host/executors/shader_files.hpp"
#include "host/executors/shader_probe.hpp"
#include "host/executors/specialise.hpp"
#include "host/executors/wavefront.hpp"
#include "host/executors/workgroups.hpp"
#include "host/gpu/command_list.hpp"
#include "host/gpu/kernel_compiler.hpp"
#include "host/gpu/self_test.hpp"
#include "host/pack/collapse.hpp"
#include "host/pack/pack.hpp"

namespace eyeray::executors {
namespace {

// The most pixels of one dispatch: 32 MiB of samples.
constexpr int64_t most_pixels = 1 << 20;
// How long one dispatch should take: short enough for a desktop's GPU watchdog and for Ctrl-C.
constexpr double wanted_seconds = 0.05;
// Where a triangle is less than a pixel, rays of a packet hardly share a leaf: beyond so many primitives each
// ray goes alone, unless packets are asked for (docs/performance.md).
constexpr size_t most_in_packets = 1 << 20;
// Pictures take packets where they save more than their kernels take to make: of so many samples, and up to
// so many primitives.
constexpr int64_t least_samples_in_wavefront = 1 << 22;
constexpr size_t most_in_wavefront = 1 << 18;
// How many pixels to dispatch at a time, learnt from how long the last ones took.
class DispatchSize {
 public:
  int rows(int width) const { return int(std::max<int64_t>(1, pixels_ / width)); }
  void took(int64_t pixels, double seconds) {
    const double wanted = double(pixels) * wanted_seconds / std::max(seconds, 1e-6);
    pixels_ = std::clamp(int64_t(wanted), int64_t{64}, std::min(8 * pixels_, most_pixels));
  }

 private:
  int64_t pixels_ = 1 << 14;
};

class GpuExecutor final : public Executor {
 public:
  GpuExecutor(const Scene& scene, const ExecutorOptions& options)
      : options_(options),
        fault_(options.fault),
        eye_(scene.camera.eye),
        device_(times_.measure("device", [&] { return open_device(options); })),
        profile_(choose_profile(options.profile, device_.info())),
        shaders_(options.shader_folder, "") {
    facts_ = times_.measure("self-test", [&] {
      return gpu::self_test(
          device_, [](std::string_view name) { return ShaderFiles({}, "").read(name); }, cache_);
    });
    records::PackedScene packed = times_.measure("pack", [&] { return pack::pack(scene, options.pack); });
    fault_.damage(packed);
    specialise_for(packed);
    times_.measure("upload", [&] { upload(packed); });
    if (packets_ && worth_wavefront(scene.image, packed))
      make_wavefront(packed);
    else
      sample_kernel_ = make_kernel("kernels/render.comp.glsl", "");
    check_validation();
  }

  bool sample(const Rect& tile, uint32_t index, std::span<PixelSample> out) override {
    const auto trace = [&](const shader::Dispatch& push, gpu::Buffer& output) {
      return wavefront_ ? wavefront_->run(push, output) : dispatch(*sample_kernel_, push, output);
    };
    return for_bands<shader::SampleResult>(tile, index, trace, [&](size_t first, auto results) {
      constexpr size_t piece = 4096;
      parallel_for(0, int((results.size() + piece - 1) / piece), [&](int p) {
        const size_t begin = size_t(p) * piece, end = std::min(results.size(), begin + piece);
        for (size_t i = begin; i < end; ++i) out[first + i] = to_sample(results[i], options_.ray_kinds);
      });
      fault_.damage(out.subspan(first, results.size()));
    });
  }

  void first_hits(const Rect& tile, std::span<FirstHit> out) override {
    if (!hit_kernel_) hit_kernel_ = make_kernel("kernels/render.comp.glsl", "#define FIRST_HITS\n");
    const auto trace = [&](const shader::Dispatch& push, gpu::Buffer& output) {
      return dispatch(*hit_kernel_, push, output);
    };
    for_bands<shader::HitResult>(tile, 0, trace, [&](size_t first, auto results) {
      for (size_t i = 0; i < results.size(); ++i) {
        check_traced(results[i].flags);
        out[first + i] = to_first_hit(results[i], eye_, options_.search_cost);
      }
    });
  }

  // By the loop, whatever makes the picture: so has the wavefront the same bits.
  Probed probe(int x, int y, uint32_t index) override {
    CHECK(options_.ray_kinds);
    const std::string entry = "kernels/render.comp.glsl";
    const ShaderProbe probe(read_shader(entry).files);
    const std::unique_ptr<gpu::Kernel> kernel = make_kernel(entry, probe.defines());
    gpu::Buffer records(device_, ShaderProbe::capacity * sizeof(shader::ProbeRecord), "probe");
    kernel->set_buffer(BINDING_PROBE, records);
    const auto trace = [&](const shader::Dispatch& push, gpu::Buffer& output) {
      return dispatch(*kernel, push, output);
    };
    Probed result;
    for_bands<shader::SampleResult>({x, y, 1, 1}, index, trace, [&](size_t, auto results) {
      result.sample = to_sample(results[0], true);
      fault_.damage(std::span(&result.sample, 1));
    });
    stop_if_interrupted();
    result.rays = probe.tree(records.read_records<shader::ProbeRecord>(ShaderProbe::capacity));
    return result;
  }

  double query(const QueryBatch& batch, std::span<QueryHit> hits) override {
    CHECK_EQ(batch.rays.size(), hits.size());
    const bool any = batch.kind == QueryKind::any;
    const Rays how = batch.coherent ? (packets_ ? Rays::packets : Rays::lanes) : incoherent_;
    gpu::Kernel& kernel = query_kernel(how, any);
    double seconds = 0;
    for (size_t first = 0; first < batch.rays.size(); first += most_pixels) {
      const size_t count = std::min(batch.rays.size() - first, size_t{most_pixels});
      seconds += query_some(kernel, how, batch.rays.subspan(first, count), hits.subspan(first, count));
    }
    check_validation();
    return seconds;
  }

  uint64_t geometry_bytes() const override { return geometry_bytes_; }

  std::string description() const override {
    const gpu::DeviceInfo& info = device_.info();
    return fmt::format("gpu: {}, {}; {}", info.name, info.driver_version, describe(profile_));
  }

  std::vector<std::filesystem::path> source_files() const override {
    return {shaders_.looked_for().begin(), shaders_.looked_for().end()};
  }

 private:
  static gpu::Device open_device(const ExecutorOptions& options) {
    gpu::DeviceOptions device;
    device.select = options.device;
    device.validation = options.validation;
    device.timeout_seconds = options.timeout_seconds;
    return gpu::Device(device);
  }

  void check_traced(uint32_t flags) const {
    if (flags & FLAG_LOOP_BUDGET)
      throw Error(ExitCode::no_device,
                  "{} ends loops after 65 535 iterations, before a ray was traced: use a newer driver, or "
                  "--backend twin",
                  device_.info().driver_version);
  }

  bool worth_wavefront(const ImageSettings& image, const records::PackedScene& packed) const {
    const int64_t samples = int64_t{image.width} * image.height * image.samples;
    return options_.profile.rays == "packets" ||
           (samples >= least_samples_in_wavefront && packed.primitives.size() <= most_in_wavefront);
  }

  void specialise_for(records::PackedScene& packed) {
    Specialisation specialisation;
    specialisation.constants = options_.constants && profile_.constants;
    specialisation.profile = profile_;
    specialisation.ray_kinds = options_.ray_kinds;
    specialisation.search_cost = options_.search_cost;
    const uint32_t lanes = device_.info().limits.subgroup_size;
    const bool worth_it = packed.primitives.size() <= most_in_packets || options_.profile.rays == "packets";
    packets_ = profile_.packets && worth_it && packed.has_bvh && packed.quantised_nodes &&
               packed.instances.empty() && packed.leaf_uses.empty() &&
               (lanes == 4 || lanes == 8 || lanes == 16);
    specialisation.subgroup_size = lanes;
    incoherent_ = incoherent_rays(profile_, packed, packets_, lanes);
    if (incoherent_ == Rays::cooperative) {
      binary_nodes_ = packed.nodes;
      bvh_ = packed.bvhs[0];
    }
    if (packets_)
      specialisation.packet_bvh =
          times_.measure("collapse", [&] { return pack::add_packet_bvh(packed, lanes); });
    if (facts_.loop_cap) specialisation.loop_budget = loop_budget_of(packed, device_.info().driver_version);
    workgroups_.subgroup = lanes;
    if (device_.info().type == gpu::DeviceType::cpu)
      workgroups_.stride = std::max(1u, std::thread::hardware_concurrency());
    specialisation.group_stride = workgroups_.stride;
    shaders_ = ShaderFiles(options_.shader_folder, specialise(packed, specialisation));
  }

  void upload(const records::PackedScene& packed) {
    for (const SceneBuffer& buffer : scene_buffers(packed)) add_buffer(buffer);
  }

  void add_buffer(const SceneBuffer& source) {
    const bool texels = source.texels && profile_.texel_buffers;
    gpu::Buffer buffer(device_, source.size(), source.name,
                       texels ? gpu::BindingKind::texels : gpu::BindingKind::storage);
    uploaded_ += buffer.size();
    if (source.geometry) geometry_bytes_ += buffer.size();
    if (uploaded_ > device_.info().limits.heap)
      throw Error(ExitCode::no_device,
                  "the scene needs more than the {} bytes of memory that {} has: {} up to buffer '{}'",
                  device_.info().limits.heap, device_.info().name, uploaded_, source.name);
    if (!source.bytes.empty()) buffer.upload(source.bytes);
    buffers_.emplace_back(source.binding, std::move(buffer));
  }

  gpu::ShaderSource read_shader(const std::string& entry) {
    const auto read = [&](std::string_view name) {
      auto text = shaders_.read(name);
      return text ? std::optional(fault_.damage(name, std::move(*text))) : std::nullopt;
    };
    return gpu::read_shader(read, entry);
  }

  std::unique_ptr<gpu::Kernel> make_kernel(const std::string& entry, const std::string& defines) {
    gpu::KernelOptions how{
        .strict = device_.info().float_modes, .optimise = options_.optimise, .flatten = profile_.flatten};
    if (options_.fast_math || fault_.contracts()) how.strict = std::nullopt;
    const std::vector<uint32_t> spirv = times_.measure("shader compile", [&] {
      try {
        return gpu::compile_kernel(read_shader(entry), defines, how, cache_).spirv;
      } catch (const InputError& error) {
        std::vector<Diagnostic> diagnostics = error.diagnostics();
        for (Diagnostic& d : diagnostics) d.position.file = shaders_.shown(d.position.file);
        throw InputError(std::move(diagnostics));
      }
    });
    auto kernel = times_.measure(
        "pipeline", [&] { return std::make_unique<gpu::Kernel>(device_, spirv, entry, cache_); });
    for (const auto& [binding, buffer] : buffers_) kernel->set_buffer(binding, buffer);
    return kernel;
  }

  // Calls trace(push, output) for `tile` in bands of rows, and take(first, results) with each band's results
  // and the index of its first pixel. Returns false when interrupted.
  template <typename Result, typename Trace, typename Take>
  bool for_bands(const Rect& tile, uint32_t index, const Trace& trace, const Take& take) {
    for (int row = 0; row < tile.height;) {
      if (interrupted()) return false;
      const int height = std::min(dispatch_size_.rows(tile.width), tile.height - row);
      const size_t pixels = size_t(height) * size_t(tile.width);
      gpu::Buffer& output = output_for(pixels * sizeof(Result));
      shader::Dispatch push{};
      push.tile_x = uint32_t(tile.x) + fault_.shift();
      push.tile_y = uint32_t(tile.y + row);
      push.tile_width = uint32_t(tile.width);
      push.tile_height = uint32_t(height);
      push.sample_index = index;
      push.count = uint32_t(pixels);
      const std::optional<double> seconds = trace(push, output);
      if (!seconds) return false;
      times_.add("dispatch", *seconds);
      dispatch_size_.took(int64_t(pixels), *seconds);

      times_.measure("read-back", [&] {
        const std::byte* bytes = output.read(pixels * sizeof(Result)).data();
        take(size_t(row) * size_t(tile.width), std::span(reinterpret_cast<const Result*>(bytes), pixels));
      });
      row += height;
    }
    check_validation();
    return true;
  }

  // kernels/render.comp.glsl for a whole tile.
  std::optional<double> dispatch(gpu::Kernel& kernel, const shader::Dispatch& push, gpu::Buffer& output) {
    kernel.set_buffer(BINDING_OUTPUT, output);
    return gpu::dispatch(device_, kernel, std::as_bytes(std::span(&push, 1)),
                         {workgroups_.of_items(Workgroups::pixels(push.tile_width, push.tile_height)), 1, 1})
        .seconds;
  }

  void make_wavefront(const records::PackedScene& packed) {
    WavefrontOptions options;
    options.shadow_rays = casts_shadow_rays(packed) ? uint32_t(packed.lights.size()) : 0;
    options.bounces = most_bounces(packed);
    options.splits = packed.media.size() > 1;
    options.bounced = bounced_rays(profile_, packed, incoherent_);
    options.workgroups = workgroups_;
    const bool cooperative = options.bounced == Rays::cooperative && options.bounces > 0 && !options.splits;
    if (cooperative) upload_bvh4();
    const std::string stack = cooperative ? bvh4_defines() : "";
    wavefront_.emplace(
        device_,
        [&](const std::string& entry, const std::string& defines) {
          return make_kernel(entry, defines + stack);
        },
        options);
  }

  // The BVH for four lanes a ray, once.
  void upload_bvh4() {
    if (binary_nodes_.empty()) return;
    const pack::CollapsedBvh bvh4 =
        times_.measure("collapse", [&] { return pack::collapse(binary_nodes_, bvh_); });
    free_memory(binary_nodes_);
    bvh4_stack_ = bvh4.stack_size;
    add_buffer(bvh4_buffer(bvh4.nodes));
  }
  std::string bvh4_defines() const { return fmt::format("#define BVH4_STACK_SIZE {}\n", bvh4_stack_); }

  gpu::Kernel& query_kernel(Rays how, bool any) {
    std::unique_ptr<gpu::Kernel>& kernel = query_kernels_[any][size_t(how)];
    if (kernel) return *kernel;
    if (how == Rays::cooperative) upload_bvh4();
    constexpr const char* entries[] = {"kernels/query.comp.glsl", "kernels/cooperative/packet.comp.glsl",
                                       "kernels/cooperative/bvh4.comp.glsl"};
    std::string defines = any ? "#define QUERY_ANY\n" : "";
    if (how == Rays::cooperative) defines += bvh4_defines();
    kernel = make_kernel(entries[size_t(how)], defines);
    return *kernel;
  }

  double query_some(gpu::Kernel& kernel, Rays how, std::span<const Query> rays, std::span<QueryHit> hits) {
    std::vector<shader::QueryRay> asked(rays.size());
    std::transform(rays.begin(), rays.end(), asked.begin(),
                   [&](const Query& ray) { return to_query_ray(ray, eye_); });
    gpu::Buffer input(device_, asked.size() * sizeof(shader::QueryRay), "rays");
    input.upload_records(asked);
    gpu::Buffer& output = output_for(asked.size() * sizeof(shader::QueryHit));
    kernel.set_buffer(BINDING_RAYS, input);
    kernel.set_buffer(BINDING_OUTPUT, output);
    const auto count = uint32_t(asked.size());
    shader::Dispatch push{};
    push.count = count;
    const uint32_t groups =
        how == Rays::packets ? workgroups_.of_packets(count) : workgroups_.of_items(count);
    const gpu::RunTime time =
        gpu::dispatch(device_, kernel, std::as_bytes(std::span(&push, 1)), {groups, 1, 1});

    const std::vector<shader::QueryHit> answers = output.read_records<shader::QueryHit>(count);
    for (size_t i = 0; i < count; ++i) {
      check_traced(answers[i].flags);
      hits[i] = to_query_hit(answers[i]);
    }
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
  Fault fault_;
  Vec3 eye_;
  DiskCache cache_ = DiskCache::of_user();
  gpu::Device device_;
  Profile profile_;
  gpu::DeviceFacts facts_;
  ShaderFiles shaders_;
  Workgroups workgroups_;
  bool packets_ = false;                   // whether kernels/cooperative/packet.comp.glsl is used
  Rays incoherent_ = Rays::lanes;          // how incoherent rays are traced
  RawVector<shader::uvec4> binary_nodes_;  // until they are collapsed
  shader::Bvh bvh_{};                      // of the world
  uint32_t bvh4_stack_ = 1;                // CollapsedBvh::stack_size
  uint64_t geometry_bytes_ = 0;
  std::vector<std::pair<uint32_t, gpu::Buffer>> buffers_;
  std::optional<gpu::Buffer> output_;
  std::unique_ptr<gpu::Kernel> sample_kernel_;
  std::unique_ptr<gpu::Kernel> hit_kernel_;
  std::optional<Wavefront> wavefront_;                // in place of sample_kernel_, where packets are traced
  std::unique_ptr<gpu::Kernel> query_kernels_[2][3];  // by whether any hit will do, and by Rays
  uint64_t uploaded_ = 0;                             // bytes
  DispatchSize dispatch_size_;
};

}  // namespace

std::unique_ptr<Executor> make_gpu_executor(const Scene& scene, const ExecutorOptions& options) {
  return std::make_unique<GpuExecutor>(scene, options);
}

}  // namespace eyeray::executors
