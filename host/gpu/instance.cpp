#include "host/gpu/instance.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "host/core/error.hpp"
#include "host/core/memory_shortage.hpp"
#include "host/core/option_text.hpp"
#include "host/core/termination.hpp"
#include "host/gpu/physical_device.hpp"
#include "host/gpu/vector_width.hpp"

namespace eyeray::engine::gpu {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

// Advice if no driver has a device. If one of the environment variables below names drivers, the loader sees
// no others.
std::string way_out() {
  std::string variables;
  for (const char* variable : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
    const char* const value = std::getenv(variable);
    if (!value || !*value) continue;
    const bool is_lost = !std::strchr(value, ':') && !std::filesystem::exists(value);
    variables += fmt::format("{}={} {}, correct or unset it; ", variable, value,
                             is_lost ? "names no file" : "allows no other driver");
  }
  return fmt::format(
      "{}install one (Debian: apt install mesa-vulkan-drivers, which renders on the processor too), or "
      "render without Vulkan with {}",
      variables, option_text("backend", "twin"));
}

// Bytes of address space that a driver needs; with less, its own threads may crash or hang. On lavapipe with
// two threads, all of 8 cold starts of whitted succeeded with 800 MiB, but only one of 8 with 600 MiB.
constexpr size_t needed_addresses = size_t{1} << 30;

// True if a driver of this machine makes pictures sooner with wide vectors. A driver's version is known only
// once it is loaded. When this instance is gone, the driver is loaded again, with the chosen width.
bool finds_gain_from_wide_vectors(double timeout_seconds) {
  DeviceOptions options;
  options.timeout_seconds = timeout_seconds;
  const Instance instance(options);
  return std::ranges::any_of(instance.physical_devices(), [](VkPhysicalDevice device) {
    return gains_from_wide_vectors(describe(device, 0).driver_version);
  });
}

// Chooses the vectors' width, once in a process, before it has an instance.
void choose_vector_width(const DeviceOptions& options) {
  static bool chosen = false;
  if (std::exchange(chosen, true) || !options.sets_environment) return;
  set_vector_width(options.wide_vectors && may_widen_vectors() &&
                   finds_gain_from_wide_vectors(options.timeout_seconds));
}

// Opens the loader, once in a process. For tests, EYERAY_VULKAN_LOADER names another loader than the
// system's.
void open_loader() {
  static bool opened = false;
  if (opened) return;
  const char* chosen = std::getenv("EYERAY_VULKAN_LOADER");
  void* library = dlopen(chosen ? chosen : "libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  void* entry = library ? dlsym(library, "vkGetInstanceProcAddr") : nullptr;
  if (!entry) {
    const char* reason = dlerror();
    throw Error(ExitCode::no_device,
                "there is no Vulkan loader on this machine: install it and a driver (Debian: apt install "
                "libvulkan1 mesa-vulkan-drivers), or render without Vulkan with {}; {}",
                option_text("backend", "twin"), reason ? reason : "vkGetInstanceProcAddr is missing");
  }
  volkInitializeCustom(reinterpret_cast<PFN_vkGetInstanceProcAddr>(entry));
  opened = true;
}

VkBool32 VKAPI_PTR collect_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                   const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto& log = *static_cast<ValidationLog*>(user);
  const std::lock_guard lock(log.mutex);
  log.messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

// A messenger for warnings and errors of the validation layer. It leaves out messages of type GENERAL: these
// are the loader's, about drivers that are not used.
VkDebugUtilsMessengerCreateInfoEXT messenger_info(ValidationLog& log) {
  auto info =
      make<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType =
      VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = collect_message;
  info.pUserData = &log;
  return info;
}

void require_validation_layer() {
  uint32_t count = 0;
  check(vkEnumerateInstanceLayerProperties(&count, nullptr), "list its layers");
  std::vector<VkLayerProperties> layers(count);
  check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "list its layers");
  for (const VkLayerProperties& layer : layers)
    if (std::strcmp(layer.layerName, validation_layer) == 0) return;
  throw Error(ExitCode::no_device,
              "validation needs {}: install it (Debian: apt install vulkan-validationlayers)",
              validation_layer);
}

}  // namespace

Instance::Instance(const DeviceOptions& options) : Instance(options.timeout_seconds) {
  const std::string& validation = options.validation;
  if (!validation.empty() && validation != "core" && validation != "sync")
    throw Error(ExitCode::bad_input, "validation is \"core\" or \"sync\", not \"{}\"", validation);
  if (!address_space_left(needed_addresses))
    throw Error(
        ExitCode::no_device,
        "Vulkan drivers need a GiB of address space, but less is left: allow more (ulimit -v), or use {}",
        option_text("backend", "twin"));
  choose_vector_width(options);
  const ForeignCall drivers(timeout_seconds_, late_start(timeout_seconds_));
  open_loader();
  if (volkGetInstanceVersion() < VK_API_VERSION_1_1)
    throw Error(ExitCode::no_device, "the Vulkan loader has version 1.0, but eyeray needs 1.1 or later");

  // Request Vulkan 1.2 if the loader knows it, since 1.2 names the driver. A device of 1.1 still suffices.
  auto application = make<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "eyeray";
  application.apiVersion = std::min<uint32_t>(volkGetInstanceVersion(), VK_API_VERSION_1_2);
  auto info = make<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;

  // Chain the messenger, so that it also watches the creation of the instance. "sync" watches only hazards,
  // "core" all else.
  const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(*log_);
  const VkValidationFeatureEnableEXT enable = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  const VkValidationFeatureDisableEXT disable = VK_VALIDATION_FEATURE_DISABLE_CORE_CHECKS_EXT;
  auto features = make<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, &messenger);
#ifdef VK_EXT_layer_settings
  // Layers that know settings ignore the buffers that shaders read and write, unless this setting is on.
  const VkBool32 yes = VK_TRUE;
  const VkLayerSettingEXT shader_accesses{validation_layer, "syncval_shader_accesses_heuristic",
                                          VK_LAYER_SETTING_TYPE_BOOL32_EXT, 1, &yes};
  auto settings =
      make<VkLayerSettingsCreateInfoEXT>(VK_STRUCTURE_TYPE_LAYER_SETTINGS_CREATE_INFO_EXT, &messenger);
#endif
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  if (!validation.empty()) {
    require_validation_layer();
    if (validation == "sync") {
      features.disabledValidationFeatureCount = 1;
      features.pDisabledValidationFeatures = &disable;
      features.enabledValidationFeatureCount = 1;
      features.pEnabledValidationFeatures = &enable;
#ifdef VK_EXT_layer_settings
      settings.settingCount = 1;
      settings.pSettings = &shader_accesses;
      features.pNext = &settings;
#endif
    }
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &validation_layer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
  }

  const VkResult result = vkCreateInstance(&info, nullptr, &instance_);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
    throw Error(ExitCode::no_device, "there is no Vulkan driver on this machine ({}): {}",
                result_name(result), way_out());
  check(result, "create an instance");
  volkLoadInstance(instance_);
  if (!validation.empty())
    check(vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_),
          "listen to the validation layer");
}

Instance::~Instance() {
  if (!instance_) return;
  if (messenger_) vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
  vkDestroyInstance(instance_, nullptr);
}

std::vector<VkPhysicalDevice> Instance::physical_devices() const {
  const ForeignCall drivers(timeout_seconds_, late_start(timeout_seconds_));
  uint32_t count = 0;
  const VkResult result = vkEnumeratePhysicalDevices(instance_, &count, nullptr);
  // Mesa's drivers return INITIALIZATION_FAILED if none of them finds its hardware.
  if (result == VK_ERROR_INITIALIZATION_FAILED || (result == VK_SUCCESS && count == 0))
    throw Error(ExitCode::no_device, "no Vulkan driver on this machine offers a device: {}", way_out());
  check(result, "list its devices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(instance_, &count, devices.data()), "list its devices");
  return devices;
}

std::vector<std::string> Instance::validation_messages() const {
  const std::lock_guard lock(log_->mutex);
  return log_->messages;
}

}  // namespace eyeray::engine::gpu
