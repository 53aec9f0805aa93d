#include "host/gpu/device_choice.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;
using gpu::DeviceInfo;
using gpu::DeviceType;

namespace {

DeviceInfo made_up(int index, const std::string& name, DeviceType type, const std::string& why_not = "") {
  DeviceInfo info;
  info.index = index;
  info.name = name;
  info.type = type;
  info.usable = why_not.empty();
  info.why_not = why_not;
  return info;
}

const std::vector<DeviceInfo> machine = {
    made_up(0, "llvmpipe (LLVM 15)", DeviceType::cpu),
    made_up(1, "Intel UHD", DeviceType::integrated),
    made_up(2, "Old GeForce", DeviceType::discrete, "it supports Vulkan 1.0.3, but eyeray needs 1.1"),
    made_up(3, "Radeon RX", DeviceType::discrete),
};

}  // namespace

TEST_CASE("the device is chosen by sort, index or part of its name") {
  CHECK(gpu::choose_device(machine, "auto").index == 3);
  CHECK(gpu::choose_device(machine, "gpu").index == 3);
  CHECK(gpu::choose_device(machine, "cpu").index == 0);
  CHECK(gpu::choose_device(machine, "1").index == 1);
  CHECK(gpu::choose_device(machine, "LLVM").index == 0);
  CHECK(gpu::choose_device(std::span(machine).first(3), "auto").index == 1);
}

TEST_CASE("an unusable device is named with its reasons, and the others are listed") {
  const auto [unusable, code] = error_of([] { gpu::choose_device(machine, "geforce"); });
  CHECK(code == ExitCode::no_device);
  CHECK(contains(unusable, "2  Old GeForce: not usable: it supports Vulkan 1.0.3, but eyeray needs 1.1"));
  CHECK(contains(error_of([] { gpu::choose_device(machine, "2"); }).first,
                 "no device that matches --device 2 is usable"));
  const std::string unknown = error_of([] { gpu::choose_device(machine, "7"); }).first;
  CHECK(contains(unknown, "no Vulkan device matches --device 7"));
  CHECK(contains(unknown, "3  Radeon RX"));
  CHECK(contains(error_of([] { gpu::choose_device(std::span(machine).first(1), "gpu"); }).first,
                 "matches --device gpu"));
}

TEST_CASE("this machine's devices report their properties") {
  const std::vector<DeviceInfo> devices = gpu::list_devices();
  REQUIRE(!devices.empty());
  const DeviceInfo& info = device().info();
  CHECK(info.usable);
  CHECK(info.name != "");
  CHECK(info.api_version.starts_with("1."));
  CHECK(info.limits.storage_range >= 1u << 27);
  CHECK(info.limits.heap > info.limits.storage_range);
  CHECK(info.limits.groups[0] >= 65535);
  CHECK(info.limits.group_invocations >= 128);
  CHECK(info.limits.subgroup_size >= 1);
  CHECK(error_of([] { gpu::Device({.select = "no such"}); }).second == ExitCode::no_device);
  CHECK(error_of([] { gpu::Device({.validation = "no such"}); }).second == ExitCode::bad_input);
}
