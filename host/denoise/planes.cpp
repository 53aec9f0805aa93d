#include "host/denoise/planes.hpp"

namespace eyeray::engine::denoise {

Planes blurred(const Planes& planes, int radius) {
  const int width = planes.width(), height = planes.height();
  const float part = 1.0f / float(2 * radius + 1);
  Planes across(width, height, planes.count());
  Planes result(width, height, planes.count());
  for (int plane = 0; plane < planes.count(); ++plane) {
    parallel_for(-radius, height + radius, [&](int y) {
      for (int x = 0; x < width; ++x) {
        float sum = 0;
        for (int i = -radius; i <= radius; ++i) sum += *planes.at(plane, x + i, y);
        *across.at(plane, x, y) = sum * part;
      }
    });
    parallel_for(0, height, [&](int y) {
      for (int x = 0; x < width; ++x) {
        float sum = 0;
        for (int i = -radius; i <= radius; ++i) sum += *across.at(plane, x, y + i);
        *result.at(plane, x, y) = sum * part;
      }
    });
  }
  result.extend();
  return result;
}

}  // namespace eyeray::engine::denoise
