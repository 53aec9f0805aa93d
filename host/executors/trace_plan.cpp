#include "host/executors/trace_plan.hpp"

#include <set>

#include "host/pack/collapse.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::engine::executors {
namespace {

// If triangles are smaller than pixels, rays of a packet hardly share a leaf. So beyond this many primitives
// each ray is traced alone, unless packets are requested (docs/performance.md).
constexpr size_t most_in_packets = 1 << 20;
// Pictures use packets where these save more time than making their kernels takes: from so many samples on,
// and up to so many primitives.
constexpr int64_t least_samples_in_wavefront = 1 << 22;
constexpr size_t most_in_wavefront = 1 << 18;
// With more lanes than this, packets are slower than rays traced alone.
constexpr uint32_t most_lanes_in_wavefront = 8;
// Vectors of 512 bits are used for pictures of so many samples, where they save more time than compiling for
// them takes. In scenes of more primitives than this, packets in narrower vectors are faster.
constexpr int64_t least_samples_in_wide_vectors = 1 << 20;
constexpr size_t most_in_wide_vectors = 1 << 14;

bool only_triangles(const records::PackedScene& scene) {
  return scene.bvh_kinds == std::set<uint32_t>{shader::KIND_triangle};
}

// True if the cooperative kernels can traverse a BVH that is made from the scene's BVH.
bool collapsible(const records::PackedScene& scene) {
  return scene.has_bvh && scene.quantised_nodes && scene.instances.empty() && scene.leaf_uses.empty();
}

Rays incoherent_rays(const Profile& profile, const records::PackedScene& scene, bool packets,
                     uint32_t subgroup_size) {
  // Up to this many primitives, BVHs are so shallow that rays are traced fastest alone (docs/performance.md).
  const bool few = scene.primitives.size() <= (only_triangles(scene) ? 1 << 9 : 1 << 10);
  const Rays wanted = profile.incoherent.value_or(few ? Rays::lanes : Rays::cooperative);
  const bool four_lanes = collapsible(scene) && subgroup_size >= pack::bvh4_children;
  const bool possible = wanted == Rays::packets ? packets : wanted == Rays::cooperative ? four_lanes : true;
  return possible ? wanted : Rays::lanes;
}

}  // namespace

TracePlan plan_tracing(const Profile& profile, const ProfileOptions& requested, const ImageSettings& image,
                       const records::PackedScene& scene, uint32_t subgroup_size) {
  const bool wants_packets = requested.rays == "packets";
  const bool packets = profile.packets && collapsible(scene) &&
                       (wants_packets || scene.primitives.size() <= most_in_packets) &&
                       (subgroup_size == 4 || subgroup_size == 8 || subgroup_size == 16);
  TracePlan plan;
  plan.coherent = packets ? Rays::packets : Rays::lanes;
  plan.incoherent = incoherent_rays(profile, scene, packets, subgroup_size);
  // Random paths diverge after the camera ray: packets save less there than the wavefront's queues cost.
  const bool pays =
      image.all_samples() >= least_samples_in_wavefront && scene.primitives.size() <= most_in_wavefront &&
      subgroup_size <= most_lanes_in_wavefront && !walks_at_random(IntegratorType(scene.frame.integrator));
  // A path that passes straight through a pane keeps its depth, which no kernel of a bounce handles. Paths
  // that gather photons mostly end at once.
  plan.wavefront = packets && (wants_packets || pays) && !scene.panes &&
                   !sends_photons(IntegratorType(scene.frame.integrator));
  // Most rays that leave a mesh hit no more of it: separate kernels do not pay (docs/performance.md).
  plan.bounced = only_triangles(scene) && !profile.incoherent ? Rays::lanes : plan.incoherent;
  return plan;
}

bool wants_wide_vectors(const ProfileOptions& requested, const ImageSettings& image,
                        const records::PackedScene& scene) {
  // Pixels gather between few and thousands of photons: the wider the vectors, the more of their lanes wait.
  if (sends_photons(IntegratorType(scene.frame.integrator))) return false;
  gpu::DeviceInfo llvmpipe;
  llvmpipe.type = gpu::DeviceType::cpu;
  llvmpipe.limits.subgroup_size = most_lanes_in_wavefront;
  const TracePlan narrow = plan_tracing(choose_profile(requested, llvmpipe), requested, image, scene,
                                        llvmpipe.limits.subgroup_size);
  const bool suits_packets = requested.rays == "packets" || scene.primitives.size() > most_in_wide_vectors;
  return image.all_samples() >= least_samples_in_wide_vectors && !(narrow.wavefront && suits_packets);
}

}  // namespace eyeray::engine::executors
