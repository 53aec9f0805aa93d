// The fuzzer's test of the model part of a 3MF file. The package around it is sound, so that its checksums
// keep no input away from the reader of the model.
#include <cstdio>
#include <cstdlib>

#include "tests/support/package.hpp"
#include "tests/support/sound_mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const std::string model(reinterpret_cast<const char*>(data), size);
    const std::string bytes = eyeray::engine::test::package_3mf(model, {{"3D/b.model", model}});
    const std::string broken =
        eyeray::engine::test::broken_promise(eyeray::engine::importers::import_bytes(bytes, "fuzz.3mf"));
    if (broken.empty()) return 0;
    std::fprintf(stderr, "broken promise: %s\n", broken.c_str());
    std::abort();
  } catch (const eyeray::engine::Error&) {
    return 0;
  }
}
