// The fuzzer's test of a mesh file's bytes. The ending of INPUT_NAME gives their format. They are refused, or
// the scene made from them keeps every promise, with points as spheres and as disks.
#include <cstdio>
#include <cstdlib>

#include "tests/support/sound_mesh.hpp"

using eyeray::engine::importers::PointShape;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    for (const PointShape shape : {PointShape::sphere, PointShape::disk}) {
      const std::string broken = eyeray::engine::test::broken_promise(eyeray::engine::importers::import_bytes(
          bytes, INPUT_NAME,
          {.point_shape = shape, .line_width = 0.01, .playing = {.seconds = 0.5}, .variant = "0"}));
      if (broken.empty()) continue;
      std::fprintf(stderr, "%s: broken promise: %s\n", INPUT_NAME, broken.c_str());
      std::abort();
    }
  } catch (const eyeray::engine::Error&) {
    return 0;
  }
  return 0;
}
