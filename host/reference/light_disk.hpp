// Lights without a position that are seen under an angle: disks of light behind all else.
#pragma once

#include "host/core/vec.hpp"
#include "host/scene/light.hpp"

namespace eyeray::engine::reference {

// `light`: as a point sees it, of an angle above 0. Of the whole disk the radiance is the same.
Vec3 disk_radiance(const Illumination& light);
// By solid angle, that disk_direction chooses a direction in it.
double disk_density(const Illumination& light);
Vec3 disk_direction(const Illumination& light, const Vec2& u);
bool in_disk(const Illumination& light, const Vec3& d);

}  // namespace eyeray::engine::reference
