// Lights without a position that are seen under an angle: disks of light behind all else.
#pragma once

#include "host/core/vec.hpp"
#include "host/scene/light.hpp"

namespace eyeray::engine::reference {

// The radiance of the disk, the same all over it. `light`: the illumination of a point, with an angle above
// 0.
Vec3 disk_radiance(const Illumination& light);
// The density, by solid angle, with which disk_direction chooses a direction in the disk.
double disk_density(const Illumination& light);
Vec3 disk_direction(const Illumination& light, const Vec2& u);
bool in_disk(const Illumination& light, const Vec3& d);

}  // namespace eyeray::engine::reference
