// eyeray devices: the choices of --device.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/cli/command.hpp"
#include "host/core/standard_streams.hpp"
#include "host/gpu/device.hpp"
#include "host/program/json.hpp"

namespace eyeray::engine::cli {
namespace {

std::string_view type_name(gpu::DeviceType type) {
  switch (type) {
    case gpu::DeviceType::discrete:
      return "discrete GPU";
    case gpu::DeviceType::integrated:
      return "integrated GPU";
    case gpu::DeviceType::virtual_gpu:
      return "virtual GPU";
    case gpu::DeviceType::cpu:
      return "CPU";
    case gpu::DeviceType::other:
      break;
  }
  return "other";
}

std::string format_bytes(uint64_t bytes) {
  if (bytes >= 1ull << 30) return fmt::format("{:.4g} GiB", double(bytes) / double(1ull << 30));
  if (bytes >= 1ull << 20) return fmt::format("{:.4g} MiB", double(bytes) / double(1ull << 20));
  return fmt::format("{} bytes", bytes);
}

void print_text(const gpu::DeviceInfo& device) {
  const gpu::DeviceLimits& limits = device.limits;
  print_lines(stdout, "{}  {} ({})\n", device.index, device.name, type_name(device.type));
  print_lines(stdout, "   driver     {} {}, Vulkan {}\n", device.driver, device.driver_version,
              device.api_version);
  print_lines(stdout, "   memory     {}, {} a buffer\n", format_bytes(limits.heap),
              format_bytes(limits.storage_range));
  print_lines(stdout, "   groups     {} invocations, subgroups of {}, {} shared\n", limits.group_invocations,
              limits.subgroup_size, format_bytes(limits.shared_memory));
  if (!device.usable) print_lines(stdout, "   unusable   {}\n", device.why_not);
}

Json as_json(const gpu::DeviceInfo& device) {
  const gpu::DeviceLimits& limits = device.limits;
  Json json{{"index", device.index},
            {"name", device.name},
            {"type", type_name(device.type)},
            {"driver", device.driver},
            {"driver_version", device.driver_version},
            {"api_version", device.api_version},
            {"usable", device.usable},
            {"limits",
             {{"storage_range", limits.storage_range},
              {"heap", limits.heap},
              {"allocation", limits.allocation},
              {"group_invocations", limits.group_invocations},
              {"groups", limits.groups},
              {"group_size", limits.group_size},
              {"shared_memory", limits.shared_memory},
              {"push_constants", limits.push_constants},
              {"subgroup_size", limits.subgroup_size}}}};
  if (!device.usable) json["why_not"] = device.why_not;
  return json;
}

ExitCode list(bool json) {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  Json all = Json::array();
  for (const gpu::DeviceInfo& device : devices) {
    all.push_back(as_json(device));
    if (!json) print_text(device);
  }
  if (json) print_json({{"devices", all}});
  const bool any = std::any_of(devices.begin(), devices.end(),
                               [](const gpu::DeviceInfo& device) { return device.usable; });
  return any ? ExitCode::ok : ExitCode::no_device;
}

}  // namespace

void add_devices(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand("devices", "List the Vulkan devices.");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Answer as JSON on standard output.");
  command->footer(
      "--device takes the number of a device, or a part of its name:\n"
      "  eyeray devices --json\n"
      "  eyeray render scenes/whitted.toml --device 0\n"
      "Exit code 3 when no device can be used.");
  command->callback([json, &run] { run = [json] { return list(*json); }; });
}

}  // namespace eyeray::engine::cli
