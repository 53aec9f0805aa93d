// The fuzzer's test of a picture's bytes: it is refused, or whole, and every point of it has a colour.
#include <cstdlib>
#include <memory>

#include "host/core/error.hpp"
#include "host/scene/image_texture_file.hpp"
#include "host/textures/make.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    eyeray::engine::image::PixelBudget budget;
    std::vector<std::string> warnings;
    const auto image = std::make_shared<eyeray::engine::ImageTexture>(eyeray::engine::decode_image_texture(
        std::as_bytes(std::span(data, size)), INPUT_NAME, budget, warnings));
    if (image->width < 1 || image->height < 1 ||
        image->texels.size() != size_t(image->width) * size_t(image->height))
      std::abort();
    const eyeray::engine::TexturePtr texture = eyeray::engine::textures::make_image(image);
    for (const double u : {-1e9, 0.0, 0.3, 1.0, 1e9}) {
      const eyeray::engine::Vec3 color = texture->at(eyeray::engine::Vec2(u, 1 - u));
      for (int i = 0; i < 3; ++i)
        if (!(color[i] >= 0 && color[i] <= 1 + 1e-12)) std::abort();  // weights sum to 1 but for rounding
    }
  } catch (const eyeray::engine::Error&) {
  }
  return 0;
}
