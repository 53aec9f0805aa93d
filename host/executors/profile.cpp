#include "host/executors/profile.hpp"

#include "host/core/error.hpp"
#include "host/executors/specialise.hpp"
#include "host/pack/collapse.hpp"

namespace eyeray::executors {
namespace {

// Whether `choice` is `yes`; `automatic` where it is empty.
bool chosen(const std::string& option, const std::string& choice, const std::string& yes,
            const std::string& no, bool automatic) {
  if (choice.empty()) return automatic;
  if (choice != yes && choice != no)
    throw Error(ExitCode::bad_input, "{} is {} or {}, not '{}'", option, yes, no, choice);
  return choice == yes;
}

// Empty: by the scene where `cpu`, else lanes.
std::optional<Rays> chosen_for_incoherent(const std::string& choice, bool cpu) {
  if (choice.empty()) return cpu ? std::nullopt : std::optional(Rays::lanes);
  if (choice == "lanes") return Rays::lanes;
  if (choice == "packets") return Rays::packets;
  if (choice == "cooperative" || choice == "wide") return Rays::cooperative;
  throw Error(ExitCode::bad_input, "--incoherent is cooperative, lanes or packets, not '{}'", choice);
}

std::string_view describe(const std::optional<Rays>& incoherent) {
  if (!incoherent) return "by the scene";
  switch (*incoherent) {
    case Rays::lanes:
      return "in lanes";
    case Rays::packets:
      return "in packets";
    case Rays::cooperative:
      return "cooperative";
  }
  return "";
}

}  // namespace

Profile choose_profile(const ProfileOptions& options, const gpu::DeviceInfo& device) {
  const std::string& profile = options.profile;
  const bool automatic = profile.empty() || profile == "auto";
  if (!automatic && profile != "cpu" && profile != "gpu" && profile != "small")
    throw Error(ExitCode::bad_input, "--profile is cpu, gpu or small, not '{}'", profile);
  // A stack in registers, a scene as constants and many branches are too much for a slow compiler
  // (docs/lavapipe.md).
  const bool small = automatic ? device.slow_compiler : profile == "small";
  const bool cpu = automatic ? device.type == gpu::DeviceType::cpu && !small : profile == "cpu";
  return {chosen("--loads", options.loads, "texels", "storage", cpu),
          chosen("--rays", options.rays, "packets", "lanes", cpu),
          chosen("--stack", options.stack, "shift", "array", cpu),
          !small,
          chosen_for_incoherent(options.incoherent, cpu),
          small};
}

Rays incoherent_rays(const Profile& profile, const records::PackedScene& scene, bool packets,
                     uint32_t subgroup_size) {
  const bool meshes = scene.bvh_kinds == std::set<uint32_t>{shader::KIND_triangle};
  // Up to here BVHs are so shallow that a ray is best alone (docs/performance.md).
  const bool few = scene.primitives.size() <= (meshes ? 1 << 9 : 1 << 10);
  const Rays wanted = profile.incoherent.value_or(few ? Rays::lanes : Rays::cooperative);
  const bool can_collapse = scene.has_bvh && scene.instances.empty() && scene.leaf_uses.empty() &&
                            scene.quantised_nodes && subgroup_size >= pack::bvh4_children;
  const bool possible = wanted == Rays::packets ? packets : wanted == Rays::cooperative ? can_collapse : true;
  return possible ? wanted : Rays::lanes;
}

Rays bounced_rays(const Profile& profile, const records::PackedScene& scene, Rays incoherent) {
  // Most rays that leave a mesh hit no more of it: not worth kernels of their own (docs/performance.md).
  const bool meshes = scene.bvh_kinds == std::set<uint32_t>{shader::KIND_triangle};
  return meshes && !profile.incoherent ? Rays::lanes : incoherent;
}

std::string describe(const Profile& profile) {
  return fmt::format("{} loads, {}, {} stack, incoherent rays {}{}{}",
                     profile.texel_buffers ? "texel" : "storage", profile.packets ? "packets" : "lanes",
                     profile.shift_stack ? "shifted" : "indexed", describe(profile.incoherent),
                     profile.constants ? "" : ", no constants", profile.flatten ? ", flattened" : "");
}

}  // namespace eyeray::executors
