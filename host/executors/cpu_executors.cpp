// The twin and the reference as executors: a row of pixels is a piece of parallel work.
#include <fmt/format.h>

#include <optional>
#include <thread>

#include "host/core/embedded_shaders.hpp"
#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/core/termination.hpp"
#include "host/executors/executors.hpp"
#include "host/executors/photon_list.hpp"
#include "host/executors/samples.hpp"
#include "host/executors/shader_files.hpp"
#include "host/executors/shader_probe.hpp"
#include "host/executors/twin_module.hpp"
#include "host/pack/pack.hpp"
#include "host/reference/photon_map.hpp"
#include "host/reference/renderer.hpp"
#include "host/scene/integrator.hpp"
#include "host/twin/twin.hpp"

namespace eyeray::engine::executors {
namespace {

// Makes out[i] = pixel(x, y) for every pixel of the grid. Returns false when interrupted.
template <typename Result, typename Pixel>
bool for_each_pixel(const Grid& grid, std::span<Result> out, const Pixel& pixel) {
  CHECK_EQ(out.size(), size_t(grid.pixels()));
  const int width = grid.width();
  try {
    parallel_for(0, grid.height(), [&](int row) {
      for (int column = 0; column < width; ++column) {
        stop_if_interrupted();
        out[size_t(row) * size_t(width) + size_t(column)] =
            pixel(grid.area.x + column * grid.stride, grid.area.y + row * grid.stride);
      }
    });
  } catch (const Error& error) {
    if (error.code() != ExitCode::interrupted) throw;
    return false;
  }
  return true;
}

// Calls answer(ray) for every ray, in parallel. Returns the seconds that this took.
template <typename Answer>
double timed_queries(std::span<const Query> rays, std::span<QueryHit> hits, const Answer& answer) {
  CHECK_EQ(rays.size(), hits.size());
  constexpr size_t piece = 1024;
  const Stopwatch watch;
  parallel_for(0, int((rays.size() + piece - 1) / piece), [&](int p) {
    const size_t end = std::min(rays.size(), (size_t(p) + 1) * piece);
    for (size_t i = size_t(p) * piece; i < end; ++i) hits[i] = answer(rays[i]);
  });
  return watch.seconds();
}

class TwinExecutor final : public Twin {
 public:
  TwinExecutor(const Scene& scene, const ExecutorOptions& options)
      : folder_(options.shader_folder), eye_(scene.camera.eye), left_out_(options.left_out) {
    if (options.twin.compile)
      times_.measure("compile", [&] { module_.emplace(folder_, options.twin.sanitizers); });
    facts_.description = description();
    if (module_) facts_.source_files = module_->files();
    times_.measure("pack", [&] { packed_ = pack::pack(scene, options.pack); });
    view_ = twin::view_of(packed_);
    if (module_)
      view_.loops = {&module_->loops(), module_->loops().most(), [](const void* guard, uint32_t loop) {
                       static_cast<const LoopGuard*>(guard)->stop(loop);
                     }};
    if (sends_photons(scene.render.integrator)) {
      photon_settings_ = photon_settings(scene);
      // Samples see no photons until the first are emitted.
      hand_over({}, 0);
    }
  }

  bool sample(const Grid& grid, uint32_t index, std::span<PixelSample> out,
              std::span<AuxiliarySample> auxiliaries) override {
    if (!send_out_photons(index)) return false;
    return times_.measure("trace", [&] {
      return for_each_pixel(grid, out, [&](int x, int y) { return sample_of(x, y, index); }) &&
             (auxiliaries.empty() || for_each_pixel(grid, auxiliaries, [&](int x, int y) {
                return to_auxiliary(functions().auxiliary(view_, uint32_t(x), uint32_t(y), index));
              }));
    });
  }

  std::vector<PhotonWay> photon_ways(uint32_t index) override {
    if (!send_out_photons(index)) stop_if_interrupted();
    return photon_ways_;
  }

  void first_hits(const Rect& tile, std::span<FirstHit> out) override {
    for_each_pixel(tile, out, [&](int x, int y) {
      return to_first_hit(functions().first_hit(view_, uint32_t(x), uint32_t(y)), eye_, true);
    });
  }

  Probed probe(int x, int y, uint32_t index) override {
    if (!send_out_photons(index)) stop_if_interrupted();
    RayRecorder recorder;
    const twin::Spectator spectator = twin::spectator_for(recorder);
    const PixelSample sample =
        to_sample(functions().sample(view_, uint32_t(x), uint32_t(y), index, &spectator), true);
    ShaderFiles shaders(module_ ? folder_ : "", "");
    std::map<std::string, std::string, std::less<>> files;
    for (const EmbeddedFile& shader : embedded_shaders())
      files.emplace(shader.name, *shaders.read(shader.name));
    ShaderProbe(files).name_files(recorder.tree());
    return {sample, std::move(recorder.tree())};
  }

  std::vector<uint32_t> events(int x, int y, uint32_t index) const override {
    std::vector<uint32_t> events;
    const twin::Spectator spectator = twin::spectator_for(events);
    functions().sample(view_, uint32_t(x), uint32_t(y), index, &spectator);
    return events;
  }

  double query(const QueryBatch& batch, std::span<QueryHit> hits) override {
    return timed_queries(batch.rays, hits, [&](const Query& ray) {
      return to_query_hit(functions().query(view_, to_query_ray(ray, eye_), batch.kind == QueryKind::any));
    });
  }

 private:
  std::string description() const {
    const std::string shaders = module_ && !folder_.empty() ? folder_.string() : "the shaders";
    const std::string how = module_ ? fmt::format(", by {} for debuggers", module_->compiler()) : "";
    return fmt::format("twin: {} as C++{}, {} threads", shaders, how, std::thread::hardware_concurrency());
  }

  PixelSample sample_of(int x, int y, uint32_t index) const {
    PixelSample sample = to_sample(functions().sample(view_, uint32_t(x), uint32_t(y), index, nullptr), true);
    sample.flags |= photon_flags_;
    return sample;
  }

  const twin::Functions& functions() const { return module_ ? module_->functions() : twin::eyeray_twin; }

  // Emits the photons of sample `index`, for samples to gather, unless they are the present ones. Returns
  // false when interrupted.
  bool send_out_photons(uint32_t index) {
    if (!photon_settings_ || photons_of_ == index) return true;
    photons_of_.reset();
    const uint32_t count = photon_settings_->count;
    photon_pass_ = photon_pass(*photon_settings_, index, eye_, 0);
    std::vector<shader::PhotonResult> results(count);
    constexpr uint32_t at_once = 256;
    std::vector<std::vector<shader::Photon>> stored((count + at_once - 1) / at_once);
    try {
      times_.measure("photons", [&] {
        parallel_for(0, int(stored.size()), [&](int piece) {
          stop_if_interrupted();
          auto& its = stored[size_t(piece)];
          const twin::PhotonSink sink{&its, [](void* to, const shader::Photon& photon) {
                                        static_cast<std::vector<shader::Photon>*>(to)->push_back(photon);
                                      }};
          const uint32_t begin = uint32_t(piece) * at_once, end = std::min(count, begin + at_once);
          for (uint32_t number = begin; number < end; ++number)
            results[number] = functions().photon(view_, index, number, sink);
        });
      });
    } catch (const Error& error) {
      if (error.code() != ExitCode::interrupted) throw;
      return false;
    }
    std::vector<shader::Photon> all;
    for (const auto& its : stored) all.insert(all.end(), its.begin(), its.end());
    hand_over(all, index);
    photon_ways_.assign(count, {});
    photon_flags_ = 0;
    for (const shader::Photon& photon : all)
      photon_ways_[photon.number].add(eye_ + Vec3(photon.position), Vec3(photon.direction),
                                      Vec3(photon.flux));
    for (uint32_t number = 0; number < count; ++number) {
      photon_ways_[number].trail = results[number].trail;
      photon_flags_ |= results[number].flags;
    }
    check_ended(photon_flags_);
    photons_of_ = index;
    return true;
  }

  void hand_over(std::span<const shader::Photon> stored, uint32_t index) {
    photon_pass_ = photon_pass(*photon_settings_, index, eye_, 0);
    photons_ = photon_list(stored, photon_pass_.key_mask, left_out_.of(index));
    view_.photon_pass = &photon_pass_;
    view_.photons = photons_.photons.data();
    view_.photon_cells = photons_.cells.data();
  }

  std::filesystem::path folder_;
  std::optional<TwinModule> module_;
  records::PackedScene packed_;
  twin::SceneView view_{};
  Vec3 eye_;

  // The photons of one sample, if the scene's integrator gathers photons.
  std::optional<PhotonSettings> photon_settings_;
  std::optional<uint32_t> photons_of_;
  shader::PhotonPass photon_pass_{};
  PhotonList photons_;
  std::vector<PhotonWay> photon_ways_;
  uint32_t photon_flags_ = 0;
  LeftOutPhotons left_out_;
};

class ReferenceExecutor final : public Executor {
 public:
  explicit ReferenceExecutor(std::shared_ptr<const reference::Renderer> renderer)
      : renderer_(std::move(renderer)) {
    facts_.description = fmt::format("reference: float64, {} threads", std::thread::hardware_concurrency());
  }

  bool sample(const Grid& grid, uint32_t index, std::span<PixelSample> out,
              std::span<AuxiliarySample> auxiliaries) override {
    return times_.measure("trace", [&] {
      return for_each_pixel(grid, out, [&](int x, int y) { return renderer_->sample(x, y, index); }) &&
             (auxiliaries.empty() || for_each_pixel(grid, auxiliaries, [&](int x, int y) {
                return renderer_->auxiliary(x, y, index);
              }));
    });
  }

  void first_hits(const Rect& tile, std::span<FirstHit> out) override {
    for_each_pixel(tile, out, [&](int x, int y) { return renderer_->first_hit(x, y); });
  }

  Probed probe(int x, int y, uint32_t index) override {
    RayRecorder recorder;
    const PixelSample sample = renderer_->sample(x, y, index, {0, 0}, {}, &recorder);
    return {sample, std::move(recorder.tree())};
  }

  double query(const QueryBatch& batch, std::span<QueryHit> hits) override {
    return timed_queries(batch.rays, hits, [&](const Query& ray) -> QueryHit {
      constexpr double none = std::numeric_limits<double>::infinity();
      uint32_t flags = 0;
      if (batch.kind == QueryKind::any) {
        const double share = renderer_->tracer().transmittance({ray.o, ray.d}, ray.t_max, flags);
        return {share == 0 ? 0 : none, -1, flags};
      }
      const auto hit = renderer_->tracer().trace({ray.o, ray.d}, flags);
      if (!hit || hit->at.t >= ray.t_max) return {none, -1, flags};
      return {hit->at.t, int64_t(hit->primitive), flags};
    });
  }

 private:
  std::shared_ptr<const reference::Renderer> renderer_;
};

}  // namespace

std::unique_ptr<Twin> make_twin_executor(const Scene& scene, const ExecutorOptions& options) {
  return std::make_unique<TwinExecutor>(scene, options);
}

std::unique_ptr<Executor> make_reference_executor(const Scene& scene, const ExecutorOptions& options) {
  auto renderer = std::make_shared<const reference::Renderer>(scene, options.pack.acceleration);
  renderer->tracer().leave_out(options.left_out);
  return make_reference_executor(std::move(renderer));
}

std::unique_ptr<Executor> make_reference_executor(std::shared_ptr<const reference::Renderer> renderer) {
  return std::make_unique<ReferenceExecutor>(std::move(renderer));
}

}  // namespace eyeray::engine::executors
