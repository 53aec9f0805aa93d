// A library with the part of Open Image Denoise's C interface that eyeray calls. Its filter mixes its inputs,
// so that a test sees that each arrives: half the colour, a quarter of the albedo and an eighth of the
// normal. A filter without albedo returns the colour. It clamps to 1 unless "hdr" is set.
#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>

namespace {

struct Device {
  const char* error = nullptr;
};
struct Filter {
  Device* device;
  std::map<std::string, float*> images = {};
  size_t values = 0;
  bool hdr = false;
  bool committed = false;
};

Device* device_of(void* device) {
  return static_cast<Device*>(device);
}
Filter* filter_of(void* filter) {
  return static_cast<Filter*>(filter);
}

}  // namespace

#define EXPORTED extern "C" __attribute__((visibility("default")))

EXPORTED void* oidnNewDevice(int type) {
  return type == 1 ? new Device : nullptr;
}
EXPORTED void oidnCommitDevice(void*) {}
EXPORTED int oidnGetDeviceError(void* device, const char** message) {
  if (!device) return 0;
  *message = device_of(device)->error;
  return *message ? 1 : 0;
}
EXPORTED void oidnReleaseDevice(void* device) {
  delete device_of(device);
}
EXPORTED void* oidnNewFilter(void* device, const char* type) {
  return type == std::string("RT") ? new Filter{device_of(device)} : nullptr;
}
EXPORTED void oidnSetSharedFilterImage(void* filter, const char* name, void* values, int format, size_t width,
                                       size_t height, size_t offset, size_t pixel_stride, size_t row_stride) {
  if (format != 3 || offset != 0 || pixel_stride != 0 || row_stride != 0)
    filter_of(filter)->device->error = "wrong layout";
  filter_of(filter)->images[name] = static_cast<float*>(values);
  filter_of(filter)->values = 3 * width * height;
}
EXPORTED void oidnSetFilter1b(void* filter, const char* name, bool value) {
  if (name == std::string("hdr")) filter_of(filter)->hdr = value;
}
EXPORTED void oidnCommitFilter(void* filter) {
  filter_of(filter)->committed = true;
}
EXPORTED void oidnExecuteFilter(void* untyped) {
  Filter& filter = *filter_of(untyped);
  if (std::getenv("FAKE_OIDN_FAILS")) filter.device->error = "out of memory";
  if (!filter.committed) filter.device->error = "not committed";
  if (filter.device->error) return;
  const float* const color = filter.images.at("color");
  const bool mixes = filter.images.contains("albedo");
  for (size_t i = 0; i < filter.values; ++i) {
    float value = color[i];
    if (mixes)
      value = 0.5f * value + 0.25f * filter.images["albedo"][i] + 0.125f * filter.images["normal"][i];
    filter.images.at("output")[i] = filter.hdr ? value : std::min(value, 1.0f);
  }
}
EXPORTED void oidnReleaseFilter(void* filter) {
  delete filter_of(filter);
}
