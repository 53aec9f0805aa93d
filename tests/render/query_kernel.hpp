// The query entry on a device, for one packed scene and one way to make its kernel; and the same rays on the
// twin.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "host/gpu/command_list.hpp"
#include "host/gpu/self_test.hpp"
#include "host/pack/collapse.hpp"
#include "host/twin/twin.hpp"
#include "support.hpp"

namespace eyeray::test {

class QueryKernel {
 public:
  // With a `collapsed`, by kernels/cooperative/bvh4.comp.glsl; else in packets or each ray alone, as the
  // profile says.
  QueryKernel(gpu::Device& device, const PackedScene& scene, const Specialisation& specialisation,
              const CollapsedBvh* collapsed = nullptr)
      : device_(device), scene_(scene), specialisation_(specialisation) {
    specialisation_.subgroup_size = device.info().limits.subgroup_size;
    const gpu::BindingKind large =
        specialisation.profile.texel_buffers ? gpu::BindingKind::texels : gpu::BindingKind::storage;
    add(BINDING_PRIMITIVES, std::as_bytes(std::span(scene.primitives)), large);
    add(BINDING_VERTICES, std::as_bytes(std::span(scene.vertices)), large);
    PackedScene with_packets = scene;
    if (traces_packets())
      specialisation_.packet_bvh = add_packet_bvh(with_packets, specialisation_.subgroup_size);
    add(BINDING_NODES, std::as_bytes(std::span(with_packets.nodes)), large);
    add(BINDING_BVHS, std::as_bytes(std::span(scene.bvhs)));
    add(BINDING_INSTANCES, std::as_bytes(std::span(scene.instances)));
    add(BINDING_MATERIALS, std::as_bytes(std::span(scene.materials)));
    add(BINDING_TEXTURES, std::as_bytes(std::span(scene.textures)));
    add(BINDING_TEXELS, std::as_bytes(std::span(scene.texels)), large);
    add(BINDING_MEDIA, std::as_bytes(std::span(scene.media)));
    add(BINDING_LIGHTS, std::as_bytes(std::span(scene.lights)));
    add(BINDING_FRAME, std::as_bytes(std::span(&scene.frame, 1)), large);
    if (traces_packets()) entry_ = "kernels/cooperative/packet.comp.glsl";
    if (collapsed) {
      add(BINDING_BVH4_NODES, std::as_bytes(std::span(collapsed->nodes)), large);
      entry_ = "kernels/cooperative/bvh4.comp.glsl";
      defines_ = fmt::format("#define BVH4_STACK_SIZE {}\n", collapsed->stack_size);
    }
  }

  // Whether rays are traced together, as the gpu executor would.
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
  void add(uint32_t binding, std::span<const std::byte> bytes,
           gpu::BindingKind kind = gpu::BindingKind::storage) {
    gpu::Buffer buffer(device_, std::max(bytes.size(), size_t{128}), "scene", kind);
    if (!bytes.empty()) buffer.upload(bytes);
    buffers_.emplace_back(binding, std::move(buffer));
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
  const PackedScene& scene_;
  Specialisation specialisation_;
  const char* entry_ = "kernels/query.comp.glsl";
  std::string defines_;
  DiskCache cache_ = DiskCache::of_user();
  std::vector<std::pair<uint32_t, gpu::Buffer>> buffers_;
  std::unique_ptr<gpu::Kernel> kernels_[2];  // by whether any hit will do
};

inline std::vector<shader::QueryHit> ask_twin(const PackedScene& scene,
                                              std::span<const shader::QueryRay> rays, bool any) {
  std::vector<shader::QueryHit> hits(rays.size());
  std::transform(rays.begin(), rays.end(), hits.begin(),
                 [&](const shader::QueryRay& ray) { return twin::query(scene, ray, any); });
  return hits;
}

inline shader::uvec4 bits(const shader::QueryHit& hit) {
  return std::bit_cast<shader::uvec4>(hit);
}

// How many of the answers are not the same to the last bit.
inline int differences(std::span<const shader::QueryHit> a, std::span<const shader::QueryHit> b) {
  int different = 0;
  for (size_t i = 0; i < a.size(); ++i) different += bits(a[i]) != bits(b[i]);
  return different;
}

}  // namespace eyeray::test
