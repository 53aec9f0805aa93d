#include "host/denoise/open_image_denoise.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <type_traits>
#include <utility>
#include <vector>

#include "host/core/error.hpp"
#include "host/denoise/alpha.hpp"

namespace eyeray::engine::denoise {
namespace {

using image::Image;

// The parts of the library's C interface that are used, as its oidn.h declares them.
struct Library {
  using Handle = void*;  // a device or a filter
  Handle (*new_device)(int type) = nullptr;
  void (*commit_device)(Handle device) = nullptr;
  int (*device_error)(Handle device, const char** message) = nullptr;
  void (*release_device)(Handle device) = nullptr;
  Handle (*new_filter)(Handle device, const char* type) = nullptr;
  void (*set_image)(Handle filter, const char* name, void* values, int format, size_t width, size_t height,
                    size_t offset, size_t pixel_stride, size_t row_stride) = nullptr;
  void (*set_bool)(Handle filter, const char* name, bool value) = nullptr;
  void (*commit_filter)(Handle filter) = nullptr;
  void (*execute_filter)(Handle filter) = nullptr;
  void (*release_filter)(Handle filter) = nullptr;
};
constexpr int cpu_device = 1, three_floats = 3;

void* open_library() {
  if (const char* chosen = std::getenv("EYERAY_OPEN_IMAGE_DENOISE"))
    return dlopen(chosen, RTLD_NOW | RTLD_LOCAL);
  for (const char* name : {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1", "libOpenImageDenoise.so"})
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
  return nullptr;
}

// Opened once in a process, and never closed.
const Library& library() {
  static const Library opened = [] {
    void* const handle = open_library();
    if (!handle) {
      const char* reason = dlerror();
      throw Error(
          ExitCode::bad_input,
          "the library Open Image Denoise is not on this machine: install it, or denoise with eyeray's own "
          "denoiser by --denoise alone; {}",
          reason ? reason : "it cannot be opened");
    }
    Library found;
    const auto find = [&](auto& function, const char* name, const char* former = nullptr) {
      void* symbol = dlsym(handle, name);
      if (!symbol && former) symbol = dlsym(handle, former);
      if (!symbol)
        throw Error(ExitCode::bad_input,
                    "the library Open Image Denoise on this machine lacks {}: install version 1.1 or later",
                    name);
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(symbol);
    };
    find(found.new_device, "oidnNewDevice");
    find(found.commit_device, "oidnCommitDevice");
    find(found.device_error, "oidnGetDeviceError");
    find(found.release_device, "oidnReleaseDevice");
    find(found.new_filter, "oidnNewFilter");
    find(found.set_image, "oidnSetSharedFilterImage");
    find(found.set_bool, "oidnSetFilterBool", "oidnSetFilter1b");
    find(found.commit_filter, "oidnCommitFilter");
    find(found.execute_filter, "oidnExecuteFilter");
    find(found.release_filter, "oidnReleaseFilter");
    return found;
  }();
  return opened;
}

class Device {
 public:
  Device() : library_(library()), device_(library_.new_device(cpu_device)) {
    if (!device_) fail();
    library_.commit_device(device_);
    check();
  }
  ~Device() {
    if (device_) library_.release_device(device_);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  // The `noisy` image without noise. `inputs`: further ones by name. `hdr`: values may be above 1. All images
  // have 3 channels.
  Image run(Image noisy, std::vector<std::pair<const char*, Image>> inputs, bool hdr) const {
    Image result(noisy.width(), noisy.height(), 3);
    const Library::Handle filter = library_.new_filter(device_, "RT");
    if (!filter) fail();
    const auto set = [&](const char* name, Image& image) {
      library_.set_image(filter, name, image.samples().data(), three_floats, size_t(image.width()),
                         size_t(image.height()), 0, 0, 0);
    };
    set("color", noisy);
    for (auto& [name, image] : inputs) set(name, image);
    set("output", result);
    library_.set_bool(filter, "hdr", hdr);
    library_.commit_filter(filter);
    library_.execute_filter(filter);
    library_.release_filter(filter);
    check();
    return result;
  }

 private:
  // Throws if the device reports an error.
  void check() const {
    const char* message = nullptr;
    if (library_.device_error(device_, &message) != 0)
      throw Error(ExitCode::bad_input, "Open Image Denoise fails: {}",
                  message ? message : "it states no reason");
  }
  [[noreturn]] void fail() const {
    check();
    throw Error(ExitCode::bad_input, "Open Image Denoise fails: it makes no device or filter");
  }

  const Library& library_;
  const Library::Handle device_;
};

Image finite(Image image) {
  for (float& each : image.samples())
    if (!std::isfinite(each)) each = 0;
  return image;
}

}  // namespace

void check_for_oidn() {
  const Device device;
}

DenoisedPicture denoise_by_oidn(const NoisyPicture& picture) {
  const Device device;
  DenoisedPicture result;
  result.color = device.run(finite(picture.color),
                            {{"albedo", finite(picture.albedo)}, {"normal", finite(picture.normal)}}, true);
  for (size_t i = 0; i < result.color.sample_count(); ++i)
    if (!std::isfinite(picture.color.samples()[i])) result.color.samples()[i] = picture.color.samples()[i];
  if (picture.coverage.sample_count() > 0) {
    const Image alpha = device.run(image::in_color(picture.coverage), {}, false);
    result.color =
        with_alpha(picture, result.color, [&](int x, int y) { return std::max(0.0f, alpha.pixel(x, y)[0]); });
  }
  return result;
}

}  // namespace eyeray::engine::denoise
