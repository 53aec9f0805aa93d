// The fuzzer's test of a .mtl file's text: for any text, the materials' values are in range.
#include <cmath>
#include <cstdlib>

#include "host/importers/obj_materials.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  eyeray::engine::importers::AssetFiles none;
  eyeray::engine::image::PixelBudget pixels;
  eyeray::engine::importers::ObjMaterials materials(none, pixels);
  materials.parse({reinterpret_cast<const char*>(data), size});
  for (const auto& material : materials.materials) {
    const eyeray::engine::Scattering s = material->scattering({eyeray::engine::Vec2(0), 1, 1, 1});
    for (const eyeray::engine::Vec3& share : {s.diffuse, s.specular, s.reflected, s.transmitted})
      for (int i = 0; i < 3; ++i)
        if (!(share[i] >= 0 && share[i] <= 1)) std::abort();
    if (!(s.shininess >= 1 && s.shininess <= 10000)) std::abort();
    if (const auto medium = material->medium(); medium && !(medium->ior >= 1 && medium->ior <= 4))
      std::abort();
  }
  return 0;
}
