#include "host/executors/profile.hpp"

#include <fmt/format.h>

#include "host/core/error.hpp"

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

std::string describe(const Profile& profile) {
  return fmt::format("{} loads, {}, {} stack, incoherent rays {}{}{}",
                     profile.texel_buffers ? "texel" : "storage", profile.packets ? "packets" : "lanes",
                     profile.shift_stack ? "shifted" : "indexed", describe(profile.incoherent),
                     profile.constants ? "" : ", no constants", profile.flatten ? ", flattened" : "");
}

}  // namespace eyeray::executors
