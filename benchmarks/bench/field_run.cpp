#include "benchmarks/bench/field_run.hpp"

#include "benchmarks/contenders/embree.hpp"

namespace eyeray::engine::bench {
namespace {

Contender contender(const contenders::Embree& embree, contenders::EmbreeCalls calls) {
  return {fmt::format("Embree {}", name(calls)),
          calls == contenders::EmbreeCalls::one ? ContenderKind::single : ContenderKind::packet,
          [&embree, calls](const Batch& batch, std::span<QueryHit> hits) {
            return embree.query(batch.rays, batch.kind, hits, calls, batch.coherent);
          }};
}

}  // namespace

SceneReport run_field(const std::string& name, const std::string& family, const Scene& scene,
                      const FieldOptions& options, std::span<const Contender> ours) {
  SceneReport report{name, family, scene.primitive_count(), {}, {}};
  const contenders::Embree embree(scene);
  report.builds.push_back({"Embree", embree.build_seconds(), embree.bytes()});

  std::vector<Contender> contenders{contender(embree, contenders::EmbreeCalls::one)};
  contenders.insert(contenders.end(), ours.begin(), ours.end());
  for (const contenders::EmbreeCalls calls :
       {contenders::EmbreeCalls::packets_of_8, contenders::EmbreeCalls::packets_of_16})
    contenders.push_back(contender(embree, calls));

  // The other two batches start at the hits of the camera rays.
  Batch primary = primary_batch(scene, options.width, options.height);
  std::vector<QueryHit> hits(primary.rays.size());
  embree.query(primary.rays, primary.kind, hits, contenders::EmbreeCalls::packets_of_8, true);
  const std::vector<SurfacePosition> from = surface_positions(scene, primary.rays, hits);
  for (const Batch& batch :
       {std::move(primary), shadow_batch(scene, from), bounce_batch(from, options.seed)}) {
    if (!batch.rays.empty())
      report.batches.push_back({batch.name, batch.rays.size(), race(batch, contenders, options.runs)});
  }
  return report;
}

}  // namespace eyeray::engine::bench
