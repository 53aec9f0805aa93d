#include "host/gpu/device_choice.hpp"

#include <algorithm>
#include <charconv>

#include "host/core/error.hpp"
#include "host/core/option_text.hpp"

namespace eyeray::engine::gpu {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return result;
}

bool matches(const DeviceInfo& device, std::string_view select) {
  if (select == "auto") return true;
  if (select == "cpu") return device.type == DeviceType::cpu;
  if (select == "gpu") return device.type != DeviceType::cpu;
  int index = 0;
  const char* end = select.data() + select.size();
  if (auto [stop, error] = std::from_chars(select.data(), end, index); error == std::errc{} && stop == end)
    return device.index == index;
  return lower(device.name).find(lower(select)) != std::string::npos;
}

std::string list(std::span<const DeviceInfo> devices) {
  std::string text;
  for (const DeviceInfo& device : devices)
    text += fmt::format("\n  {}  {}{}{}", device.index, device.name,
                        device.usable ? "" : ": not usable: ", device.why_not);
  return text;
}

}  // namespace

const DeviceInfo& choose_device(std::span<const DeviceInfo> devices, std::string_view select) {
  const DeviceInfo* best = nullptr;
  bool any_match = false;
  for (const DeviceInfo& device : devices) {
    if (!matches(device, select)) continue;
    any_match = true;
    if (device.usable && (!best || device.type < best->type)) best = &device;
  }
  if (best) return *best;
  if (any_match)
    throw Error(ExitCode::no_device, "no device that matches {} is usable; the devices are{}",
                option_text("device", select), list(devices));
  throw Error(ExitCode::no_device, "no Vulkan device matches {}; the devices are{}",
              option_text("device", select), list(devices));
}

}  // namespace eyeray::engine::gpu
