// Environments whose texels are all known.
#pragma once

#include <cmath>

#include "host/scene/environment.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::test {

// Each texel is radiance(d), where d is the direction of the texel's centre in an environment that is not
// turned.
template <typename Radiance>
std::shared_ptr<EnvironmentMap> environment(int width, int height, const Radiance& radiance,
                                            double turn = 0) {
  image::Image picture(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double azimuth = 2 * M_PI * ((x + 0.5) / width - 0.5), polar = M_PI * (y + 0.5) / height;
      const Vec3 d(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                   -std::sin(polar) * std::cos(azimuth));
      const Vec3 color = radiance(d);
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = float(color[c]);
    }
  return std::make_shared<EnvironmentMap>(std::move(picture), turn);
}

}  // namespace eyeray::engine::test
