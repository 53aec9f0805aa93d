// Lights built in code, by tests; a scene file's go through their LightType.
#pragma once

#include "host/scene/light.hpp"

namespace eyeray::engine::lights {

std::unique_ptr<Light> make_light(const PointLight& values);
std::unique_ptr<Light> make_light(const DirectionalLight& values);
std::unique_ptr<Light> make_light(const SpotLight& values);

}  // namespace eyeray::engine::lights
