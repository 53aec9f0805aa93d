#pragma once

#include "host/scene/light.hpp"

namespace eyeray::lights {

// Every kind of light, in registry order.
std::span<const LightType* const> types();

}  // namespace eyeray::lights
