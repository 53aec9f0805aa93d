// The fuzzer's test of an OpenEXR file: reading refuses it, or gives a whole picture and whole layers.
#include <cstdint>
#include <cstdlib>

#include "host/core/error.hpp"
#include "host/image/exr_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const std::string layer : {"", "depth"}) {
    try {
      std::vector<std::string> warnings;
      const eyeray::engine::image::Image image =
          eyeray::engine::image::decode_exr(bytes, INPUT_NAME, layer, warnings);
      eyeray::engine::image::decode_exr_alpha(bytes, INPUT_NAME);
      if (image.width() < 1 || image.height() < 1 || (image.channels() != 1 && image.channels() != 3))
        std::abort();
    } catch (const eyeray::engine::Error&) {
    }
  }
  return 0;
}
