#include "render/profile.hpp"

#include "core/error.hpp"

namespace eyeray {
namespace {

// Whether `choice` is `yes`; `automatic` where it is empty.
bool chosen(const std::string& option, const std::string& choice, const std::string& yes,
            const std::string& no, bool automatic) {
  if (choice.empty()) return automatic;
  if (choice != yes && choice != no)
    throw Error(ExitCode::bad_input, "{} is {} or {}, not '{}'", option, yes, no, choice);
  return choice == yes;
}

}  // namespace

Profile choose_profile(const ProfileOptions& options, const gpu::DeviceInfo& device) {
  const std::string profile = options.profile == "auto" ? "" : options.profile;
  const bool cpu = chosen("--profile", profile, "cpu", "gpu", device.type == gpu::DeviceType::cpu);
  return {chosen("--loads", options.loads, "texels", "storage", cpu),
          chosen("--stack", options.stack, "shift", "array", cpu)};
}

std::string describe(const Profile& profile) {
  return fmt::format("{} loads, {} stack", profile.texel_buffers ? "texel" : "storage",
                     profile.shift_stack ? "shifted" : "indexed");
}

}  // namespace eyeray
