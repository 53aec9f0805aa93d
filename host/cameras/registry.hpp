#pragma once

#include "host/scene/camera.hpp"

namespace eyeray::cameras {

// Every kind of camera, in registry order.
std::span<const CameraType* const> types();

}  // namespace eyeray::cameras
