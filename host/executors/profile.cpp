#include "host/executors/profile.hpp"

#include <fmt/format.h>

namespace eyeray::engine::executors {
namespace {

// The way of tracing incoherent rays by a user's choice. An empty choice means lanes, but on a CPU the scene
// decides: then there is no value.
std::optional<Rays> chosen_for_incoherent(const std::string& choice, bool cpu) {
  if (choice.empty()) return cpu ? std::nullopt : std::optional(Rays::lanes);
  return choice == "lanes" ? Rays::lanes : choice == "packets" ? Rays::packets : Rays::cooperative;
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
  const bool automatic = profile == "auto";
  // A stack in registers, a scene as constants and many branches are too much for a slow compiler
  // (docs/lavapipe.md).
  const bool small = automatic ? device.slow_compiler : profile == "small";
  const bool cpu = automatic ? device.type == gpu::DeviceType::cpu && !small : profile == "cpu";
  const auto chosen = [&](const std::string& choice, const char* on_cpu) {
    return choice.empty() ? cpu : choice == on_cpu;
  };
  return {chosen(options.loads, "texels"),
          chosen(options.rays, "packets"),
          chosen(options.stack, "shift"),
          !small,
          cpu,
          chosen_for_incoherent(options.incoherent, cpu),
          small};
}

std::string describe(const Profile& profile) {
  return fmt::format("{} loads, {}, {} stack, incoherent rays {}{}{}",
                     profile.texel_buffers ? "texel" : "storage", profile.packets ? "packets" : "lanes",
                     profile.shift_stack ? "shifted" : "indexed", describe(profile.incoherent),
                     profile.constants ? "" : ", no constants", profile.flatten ? ", flattened" : "");
}

}  // namespace eyeray::engine::executors
