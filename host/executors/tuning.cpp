#include "host/executors/tuning.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "host/core/diagnostic.hpp"
#include "host/core/error.hpp"
#include "host/executors/options.hpp"

namespace eyeray::engine::executors {
namespace {

template <std::string ProfileOptions::* part>
void choose_part(ExecutorOptions& options, std::string_view value) {
  options.gpu.profile.*part = value;
}

template <bool gpu::WorstDevice::* part>
void choose_worst(ExecutorOptions& options, std::string_view value) {
  options.gpu.worst_device.*part = value == "worst";
}

void choose_acceleration(ExecutorOptions& options, std::string_view value) {
  options.pack.acceleration = value == "bvh"    ? Acceleration::bvh
                              : value == "auto" ? Acceleration::automatic
                                                : Acceleration::brute_force;
}

const Tuning tuning_rows[] = {
    {"acceleration",
     {"auto", "bvh", "brute-force"},
     "a BVH over the scene, every primitive for every ray, or a choice by the scene",
     choose_acceleration},
    {"splits",
     {"off", "on"},
     "cuts long, thin primitives for a better BVH: slower to build, faster to trace",
     [](ExecutorOptions& options, std::string_view value) { options.pack.split = value == "on"; }},
    {"profile",
     {"auto", "cpu", "gpu", "small"},
     "the kind of device that kernels are made for, by default the device's own; it sets the next four",
     choose_part<&ProfileOptions::profile>},
    {"loads",
     {"texels", "storage"},
     "loads the scene as texels or from storage buffers",
     choose_part<&ProfileOptions::loads>},
    {"rays",
     {"packets", "lanes"},
     "traces coherent rays together, or each alone",
     choose_part<&ProfileOptions::rays>},
    {"incoherent",
     {"cooperative", "lanes", "packets"},
     "traces the rays of later bounces by four lanes each, each alone, or together",
     choose_part<&ProfileOptions::incoherent>},
    {"stack",
     {"shift", "array"},
     "keeps the stack of a BVH in registers or in an indexed array",
     choose_part<&ProfileOptions::stack>},
    {"denoise",
     {"kernels", "processor"},
     "removes noise by kernels, or by the processor: by default the device's own way",
     choose_part<&ProfileOptions::denoise>},
    {"constants",
     {"on", "off"},
     "compiles materials, lights and a small scene's shapes into the kernel",
     [](ExecutorOptions& options, std::string_view value) { options.gpu.constants = value == "on"; }},
    {"optimiser",
     {"on", "off"},
     "optimises kernels before the driver gets them; without, each start takes longer",
     [](ExecutorOptions& options, std::string_view value) { options.gpu.optimise = value == "on"; }},
    {"division",
     {"auto", "own", "exact"},
     "divides and takes roots exactly where the device does not, as the device does, or exactly in any case",
     [](ExecutorOptions& options, std::string_view value) {
       options.gpu.division = value == "auto"  ? Division::automatic
                              : value == "own" ? Division::own
                                               : Division::exact;
     }},
    {"subgroup",
     {"own", "1", "2", "4", "8", "16", "32", "64"},
     "for the emulator: the invocations of a subgroup",
     [](ExecutorOptions& options, std::string_view value) {
       options.gpu.emulated_subgroup = value == "own" ? 0 : uint32_t(std::stoul(std::string(value)));
     }},
    {"device-division",
     {"own", "worst"},
     "for tests: makes the device's division and roots as wrong as Vulkan allows",
     choose_worst<&gpu::WorstDevice::division>},
    {"device-contraction",
     {"own", "worst"},
     "for tests: rounds a·b + c once where the kernel does not forbid it",
     choose_worst<&gpu::WorstDevice::contraction>},
    {"device-denormals",
     {"own", "worst"},
     "for tests: flushes denormals to zero",
     choose_worst<&gpu::WorstDevice::denormals>},
    {"device-nan",
     {"own", "worst"},
     "for tests: lets min, max and clamp of a NaN return either operand",
     choose_worst<&gpu::WorstDevice::nan>},
};

const Tuning& tuning_of(std::string_view key) {
  const auto found = std::ranges::find(tuning_rows, key, &Tuning::key);
  if (found != std::end(tuning_rows)) return *found;
  std::vector<std::string_view> keys;
  for (const Tuning& each : tuning_rows) keys.push_back(each.key);
  const std::string nearest = nearest_name(key, keys);
  throw Error(ExitCode::bad_input, "--tune has no key '{}'{} There are {}", key,
              nearest.empty() ? "." : fmt::format("; did you mean '{}'?", nearest), fmt::join(keys, ", "));
}

}  // namespace

std::span<const Tuning> tunings() {
  return tuning_rows;
}

void tune(ExecutorOptions& options, std::string_view setting) {
  const size_t equals = setting.find('=');
  if (equals == std::string_view::npos)
    throw Error(ExitCode::bad_input, "--tune must be KEY=VALUE, such as rays=lanes, not '{}'", setting);
  const Tuning& tuning = tuning_of(setting.substr(0, equals));
  const std::string_view value = setting.substr(equals + 1);
  if (std::ranges::find(tuning.values, value) == tuning.values.end())
    throw Error(ExitCode::bad_input, "--tune {} must be one of {}, not '{}'", tuning.key,
                fmt::join(tuning.values, ", "), value);
  tuning.choose(options, value);
}

}  // namespace eyeray::engine::executors
