// eyeray devices: the choices of --device.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/cli/command.hpp"
#include "host/core/error.hpp"
#include "host/core/standard_streams.hpp"
#include "host/executors/open_device.hpp"
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

// Tests a usable device. The result states a fault instead, if the device computes wrong results.
Json self_test(const gpu::DeviceInfo& device) {
  executors::GpuOptions options;
  options.device = std::to_string(device.index);
  try {
    const gpu::DeviceFacts facts = executors::open_device(options)->facts();
    return {{"exact_arithmetic", facts.exact_arithmetic}, {"exact_division", facts.exact_division},
            {"denormals_kept", facts.denormals_kept},     {"infinities_kept", facts.infinities_kept},
            {"loop_iterations", facts.loop_iterations},   {"seconds", facts.seconds}};
  } catch (const Error& error) {
    return {{"error", error.what()}};
  }
}

void print_self_test(const Json& facts) {
  if (facts.contains("error"))
    return print_lines(stdout, "   self-test  {}\n", facts["error"].get<std::string>());
  const auto is = [&](const char* fact) { return facts[fact].get<bool>(); };
  print_lines(stdout,
              "   self-test  arithmetic {}, division {}, denormals {}, infinities {}, {} loop iterations\n",
              is("exact_arithmetic") ? "exact" : "not exact", is("exact_division") ? "exact" : "corrected",
              is("denormals_kept") ? "kept" : "lost", is("infinities_kept") ? "kept" : "lost",
              facts["loop_iterations"].get<uint32_t>());
}

ExitCode list(bool json, bool tests) {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  Json all = Json::array();
  for (const gpu::DeviceInfo& device : devices) {
    all.push_back(as_json(device));
    if (!json) print_text(device);
    if (!tests || !device.usable) continue;
    const Json& facts = all.back()["self_test"] = self_test(device);
    if (!json) print_self_test(facts);
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
  const auto tests = std::make_shared<bool>(false);
  command->add_flag("--self-test", *tests, "Also test each device's arithmetic, as every render does.");
  command->footer(
      "--device takes the number of a device, or a part of its name:\n"
      "  eyeray devices --json\n"
      "  eyeray render scenes/whitted.toml --device 0\n"
      "Exit code 3 when no device can be used.");
  command->callback([json, tests, &run] { run = [json, tests] { return list(*json, *tests); }; });
}

}  // namespace eyeray::engine::cli
