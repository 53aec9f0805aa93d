#include "benchmarks/bench/own_contenders.hpp"

#include "host/core/stopwatch.hpp"

namespace eyeray::engine::bench {

OwnContenders::OwnContenders(const Scene& scene, const std::vector<std::string>& backends,
                             const std::vector<std::string>& incoherent, const std::string& device) {
  executors::ExecutorOptions options;
  options.gpu.device = device;
  options.gpu.wide_vectors = false;  // rays are traced in packets, and by four lanes a ray
  for (const std::string& name : backends) {
    const executors::Backend backend = executors::parse_backend(name);
    if (backend != executors::Backend::gpu) {
      add(name, scene, backend, options);
      continue;
    }
    for (const std::string& how : incoherent) {
      executors::ExecutorOptions traced_so = options;
      traced_so.gpu.profile.incoherent = how;
      add(how.empty() ? name : name + " " + how, scene, backend, traced_so);
    }
  }
}

void OwnContenders::add(const std::string& name, const Scene& scene, executors::Backend backend,
                        const executors::ExecutorOptions& options) {
  const Stopwatch watch;
  executors_.push_back(executors::make_executor(backend, scene, options));
  seconds_.push_back(watch.seconds());
  executors::Executor* const executor = executors_.back().get();
  contenders_.push_back({name, ContenderKind::ours, [executor](const Batch& batch, std::span<QueryHit> hits) {
                           return executor->query({batch.rays, batch.kind, batch.coherent}, hits);
                         }});
}

std::vector<Build> OwnContenders::builds() const {
  std::vector<Build> builds;
  for (size_t i = 0; i < executors_.size(); ++i) {
    double packing = 0;
    for (const auto& [stage, spent] : executors_[i]->times().stages())
      if (stage == "pack" || stage == "collapse") packing += spent;
    builds.push_back(
        {contenders_[i].name, packing > 0 ? packing : seconds_[i], executors_[i]->facts().geometry_bytes});
  }
  return builds;
}

}  // namespace eyeray::engine::bench
