// Runs the query entry on a device, for one packed scene and one specialisation, and the same rays on the
// twin.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "host/executors/scene_buffers.hpp"
#include "host/gpu/command_list.hpp"
#include "host/gpu/self_test.hpp"
#include "host/pack/collapse.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/entries.hpp"

namespace eyeray::engine::test {

class QueryKernel {
 public:
  // With `collapsed`, kernels/cooperative/bvh4.comp.glsl traces the rays. Otherwise they are traced in
  // packets or one by one, as the profile sets.
  QueryKernel(gpu::Device& device, const records::PackedScene& scene,
              const executors::Specialisation& specialisation, const pack::CollapsedBvh* collapsed = nullptr)
      : device_(device), scene_(scene), specialisation_(specialisation) {
    specialisation_.subgroup_size = device.info().limits.subgroup_size;
    records::PackedScene with_packets = scene;
    if (traces_packets())
      specialisation_.packet_bvh = pack::add_packet_bvh(with_packets, specialisation_.subgroup_size);
    for (const executors::SceneBuffer& buffer : executors::scene_buffers(with_packets)) add(buffer);
    if (traces_packets()) entry_ = "kernels/cooperative/packet.comp.glsl";
    if (collapsed) {
      add(executors::bvh4_buffer(collapsed->nodes));
      entry_ = "kernels/cooperative/bvh4.comp.glsl";
      defines_ = fmt::format("#define BVH4_STACK_SIZE {}\n", collapsed->stack_size);
    }
  }

  // True if rays are traced in packets, by the gpu executor's rule.
  bool traces_packets() const {
    return specialisation_.profile.packets && scene_.has_bvh && scene_.quantised_nodes &&
           scene_.instances.empty() && scene_.leaf_uses.empty();
  }

  std::vector<shader::QueryHit> ask(std::span<const shader::QueryRay> rays, bool any) {
    std::unique_ptr<gpu::Kernel>& kernel = kernels_[any];
    if (!kernel) kernel = make_kernel(any);
    gpu::Buffer queries(device_, rays.size_bytes(), "rays");
    queries.upload_records(rays);
    gpu::Buffer results(device_, rays.size() * sizeof(shader::QueryHit), "hits");
    kernel->set_buffer(BINDING_RAYS, queries);
    kernel->set_buffer(BINDING_OUTPUT, results);
    shader::Dispatch push{};
    push.count = uint32_t(rays.size());
    gpu::dispatch(device_, *kernel, std::as_bytes(std::span(&push, 1)),
                  {uint32_t(rays.size() + 63) / 64, 1, 1});
    return results.read_records<shader::QueryHit>(rays.size());
  }

 private:
  void add(const executors::SceneBuffer& source) {
    const bool texels = source.texels && specialisation_.profile.texel_buffers;
    gpu::Buffer buffer(device_, source.size(), source.name,
                       texels ? gpu::BindingKind::texels : gpu::BindingKind::storage);
    if (!source.bytes.empty()) buffer.upload(source.bytes);
    buffers_.emplace_back(source.binding, std::move(buffer));
  }

  std::unique_ptr<gpu::Kernel> make_kernel(bool any) {
    const std::vector<uint32_t> spirv = gpu::compile_kernel(entry_source(entry_, scene_, specialisation_),
                                                            defines_ + (any ? "#define QUERY_ANY\n" : ""),
                                                            {device_.info().float_modes}, cache_)
                                            .spirv;
    auto kernel = std::make_unique<gpu::Kernel>(device_, spirv, entry_, cache_);
    for (const auto& [binding, buffer] : buffers_) kernel->set_buffer(binding, buffer);
    return kernel;
  }

  gpu::Device& device_;
  const records::PackedScene& scene_;
  executors::Specialisation specialisation_;
  const char* entry_ = "kernels/query.comp.glsl";
  std::string defines_;
  DiskCache cache_ = DiskCache::of_user();
  std::vector<std::pair<uint32_t, gpu::Buffer>> buffers_;
  std::unique_ptr<gpu::Kernel> kernels_[2];  // index 1: for queries that any hit answers
};

inline std::vector<shader::QueryHit> query_twin(const records::PackedScene& scene,
                                                std::span<const shader::QueryRay> rays, bool any) {
  std::vector<shader::QueryHit> hits(rays.size());
  const twin::SceneView view = twin::view_of(scene);
  std::transform(rays.begin(), rays.end(), hits.begin(),
                 [&](const shader::QueryRay& ray) { return twin::eyeray_twin.query(view, ray, any); });
  return hits;
}

inline shader::uvec4 bits(const shader::QueryHit& hit) {
  return std::bit_cast<shader::uvec4>(hit);
}

// The number of answers that differ in any bit.
inline int differences(std::span<const shader::QueryHit> a, std::span<const shader::QueryHit> b) {
  int different = 0;
  for (size_t i = 0; i < a.size(); ++i) different += bits(a[i]) != bits(b[i]);
  return different;
}

// The number of differences between the GPU's answers and the twin's, over both kinds of queries, by packets
// and by lanes.
inline int differences_on_gpu(gpu::Device& device, const records::PackedScene& packed,
                              std::span<const shader::QueryRay> rays) {
  int different = 0;
  for (const bool packets : {true, false}) {
    executors::Specialisation specialisation;
    specialisation.profile = {.texel_buffers = packets, .packets = packets, .shift_stack = packets};
    specialisation.constants = packets;
    QueryKernel kernel(device, packed, specialisation);
    for (const bool any : {false, true})
      different += differences(kernel.ask(rays, any), query_twin(packed, rays, any));
  }
  return different;
}

}  // namespace eyeray::engine::test
