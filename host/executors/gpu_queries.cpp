#include "host/executors/gpu_queries.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/executors/loop_budget.hpp"
#include "host/executors/samples.hpp"
#include "host/executors/tile_size.hpp"
#include "host/gpu/command_list.hpp"

namespace eyeray::engine::executors {

double GpuQueries::ask(const QueryBatch& batch, std::span<QueryHit> hits) {
  CHECK_EQ(batch.rays.size(), hits.size());
  const Rays how = batch.coherent ? plan_.coherent : plan_.incoherent;
  TraceKernel& chosen = kernel(how, batch.kind == QueryKind::any);
  double seconds = 0;
  for (size_t first = 0; first < batch.rays.size();) {
    const int64_t most = gpu::watched(device_.info()) ? chosen.size->items() : most_items;
    const size_t count = std::min(batch.rays.size() - first, size_t(most));
    const double some =
        query_some(*chosen.kernel, how, batch.rays.subspan(first, count), hits.subspan(first, count));
    chosen.size->took(int64_t(count), some);
    seconds += some;
    first += count;
  }
  return seconds;
}

void GpuQueries::make_kernels() {
  for (const Rays how : {plan_.coherent, plan_.incoherent})
    for (const bool any : {false, true}) kernel(how, any);
}

GpuQueries::TraceKernel& GpuQueries::kernel(Rays how, bool any) {
  TraceKernel& made = made_[any][size_t(how)];
  if (!made.kernel) {
    made.kernel = kernels_.make(trace_entries[size_t(how)], any ? "#define QUERY_ANY\n" : "");
    made.size.emplace(device_.info(), most_items);
  }
  return made;
}

double GpuQueries::query_some(gpu::Kernel& kernel, Rays how, std::span<const Query> rays,
                              std::span<QueryHit> hits) {
  std::vector<shader::QueryRay> queries(rays.size());
  std::transform(rays.begin(), rays.end(), queries.begin(),
                 [&](const Query& ray) { return to_query_ray(ray, eye_); });
  gpu::Buffer input(device_, queries.size() * sizeof(shader::QueryRay), "rays");
  input.upload_records(queries);
  const size_t bytes = queries.size() * sizeof(shader::QueryHit);
  if (!output_ || output_->size() < bytes) output_.emplace(device_, bytes, "hits of rays");
  kernel.set_buffer(BINDING_RAYS, input);
  kernel.set_buffer(BINDING_OUTPUT, *output_);
  const auto count = uint32_t(queries.size());
  shader::Dispatch push{};
  push.count = count;
  const uint32_t groups = how == Rays::packets ? workgroups_.of_packets(count) : workgroups_.of_items(count);
  const gpu::RunTime time = kernels_.run(
      [&] { return gpu::dispatch(device_, kernel, std::as_bytes(std::span(&push, 1)), {groups, 1, 1}); });

  const std::vector<shader::QueryHit> answers = output_->read_records<shader::QueryHit>(count);
  kernels_.check_loops(answers);
  for (size_t i = 0; i < count; ++i) {
    check_traced(answers[i].flags, device_.info().driver_version);
    hits[i] = to_query_hit(answers[i]);
  }
  return time.seconds;
}

}  // namespace eyeray::engine::executors
